// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/seed_relocation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

/// The unit sphere, which is its own map.
const MappedSurface& ball() {
  static const MappedSurface surface(test::sphere(5), test::sphere(5).points, Execution(1));
  return surface;
}

RelaxationOptions no_iterations() {
  RelaxationOptions options;
  options.maximum_iterations = 0;
  return options;
}

/// Places on the sphere with the cells that they have.
SpaceTessellation cells_of(const std::vector<Vector3>& seeds) {
  return relax_in_space(seeds, SphereTriangulation(seeds), ball(), {}, no_iterations(),
                        Execution(1));
}

/// 600 places, of which the upper half has 400: cells of two thirds there, and of twice that below.
SpaceTessellation crowded() {
  std::vector<Vector3> seeds;
  for (const Vector3& p : fibonacci_lattice(800)) {
    if (p.z() > 0.0) seeds.push_back(p);
  }
  for (const Vector3& p : fibonacci_lattice(400)) {
    if (p.z() < 0.0) seeds.push_back(p);
  }
  return cells_of(seeds);
}

std::ptrdiff_t above(const std::vector<Vector3>& seeds) {
  return std::count_if(seeds.begin(), seeds.end(), [](const Vector3& p) { return p.z() > 0.0; });
}

TEST(SeedRelocation, SharesTellWhereCellsAreSmallerThanWanted) {
  const SpaceTessellation tessellation = crowded();
  ASSERT_EQ(tessellation.seeds.size(), 600U);
  const std::vector<double> shares = cell_shares(ball(), {}, tessellation);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    // Away from the border of the halves cells are 300 / 400 and 300 / 200 of the wanted ones.
    if (tessellation.seeds[i].z() > 0.7) {
      EXPECT_NEAR(shares[i], 0.75, 0.02);
    }
    if (tessellation.seeds[i].z() < -0.7) {
      EXPECT_NEAR(shares[i], 1.5, 0.04);
    }
  }
  // 400 where 300 are wanted, less what the smoothing of the step between the halves takes: a step
  // of 0.75 blurred by a deviation of 2.4 edges, 0.34, loses 0.75 * 0.34 / sqrt(2 pi) on the border
  // of length 2 pi, where 400 / (2 pi) stand on a unit of area: 41.
  EXPECT_NEAR(crowded_seeds(shares), 100.0 - 41.0, 15.0);
  // As wanted where that many are wanted there: twice as many for an area as below.
  std::vector<double> densities;
  for (const Vector3& p : ball().mesh().points) densities.push_back(p.z() > 0.0 ? 2.0 : 1.0);
  EXPECT_LT(crowded_seeds(cell_shares(ball(), site_density(ball(), densities), tessellation)), 5.0);
}

TEST(SeedRelocation, TakesSeedsFromWhereTheyCrowdToWhereThereIsRoom) {
  SpaceTessellation tessellation = crowded();
  const std::vector<double> shares = cell_shares(ball(), {}, tessellation);
  const int taken = relocate_seeds(ball(), shares, tessellation);
  // All that are too many, to whole ones, but where a triangle would not stand.
  EXPECT_GE(taken, static_cast<int>(0.95 * crowded_seeds(shares)));
  EXPECT_LE(taken, static_cast<int>(crowded_seeds(shares)) + 1);
  EXPECT_EQ(above(tessellation.seeds), 400 - taken);
  // A closed triangulation that stands on the sphere everywhere: this refuses any other.
  EXPECT_NO_THROW(SphereTriangulation(tessellation.seeds, tessellation.triangulation.triangles()));
  for (std::size_t i = 0; i < tessellation.seeds.size(); ++i) {
    EXPECT_NEAR(tessellation.seeds[i].norm(), 1.0, 1e-14);
    EXPECT_EQ(tessellation.positions[i], ball().position(ball().locate(tessellation.seeds[i])));
  }
  const SpaceTessellation relaxed = relax_in_space(tessellation.seeds, tessellation.triangulation,
                                                   ball(), {}, RelaxationOptions(), Execution(1));
  EXPECT_LT(crowded_seeds(cell_shares(ball(), {}, relaxed)), 1.0);
}

TEST(SeedRelocation, LeavesEvenSeedsAlone) {
  SpaceTessellation tessellation = cells_of(fibonacci_lattice(500));
  const std::vector<Vector3> before = tessellation.seeds;
  const std::vector<double> shares = cell_shares(ball(), {}, tessellation);
  EXPECT_EQ(crowded_seeds(shares), 0.0);
  EXPECT_EQ(relocate_seeds(ball(), shares, tessellation), 0);
  EXPECT_EQ(tessellation.seeds, before);
}

}  // namespace
}  // namespace wscvt
