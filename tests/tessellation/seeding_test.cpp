// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/seeding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_error.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

SurfaceSeedModel area_model(const Ellipsoid& surface, int count) {
  WeightingOptions options;
  options.kind = Weighting::Area;
  return {surface, options, count, Execution(1)};
}

TEST(Seeding, UnrelaxedSamplingsAreTheNearestThereAre) {
  EXPECT_EQ(unrelaxed_seeds(Sampling::Fibonacci, 101), fibonacci_lattice(101));
  EXPECT_EQ(unrelaxed_seeds(Sampling::EqualAngle, 101), nearest_equal_angle_grid(101));
  EXPECT_EQ(unrelaxed_seeds(Sampling::Icosahedron, 101), nearest_subdivided_icosahedron(101));
  EXPECT_ERROR(unrelaxed_seeds(Sampling::Weighted, 101), InvalidInput);
  for (const Sampling sampling :
       {Sampling::Fibonacci, Sampling::EqualAngle, Sampling::Icosahedron}) {
    EXPECT_EQ(takes_any_count(sampling), unrelaxed_seeds(sampling, 101).size() == 101);
  }
  EXPECT_TRUE(takes_any_count(Sampling::Weighted));
}

TEST(Seeding, HandfulsOfSeedsSurroundTheCentre) {
  const Ellipsoid surface(Vector3(3.0, 1.0, 0.6));
  for (int count = 4; count <= 12; ++count) {
    SCOPED_TRACE(count);
    const std::vector<Vector3> seeds = start_seeds(area_model(surface, count), count, Execution(1));
    EXPECT_EQ(seeds.size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(SphereTriangulation::try_build(seeds));
  }
}

TEST(Seeding, WarpedStartsFollowTheDensity) {
  // Seen from the centre, cells of one area are smallest at the ends of the longest axis.
  constexpr int count = 2000;
  const Ellipsoid surface(Vector3(2.0, 1.0, 1.0));
  const SurfaceSeedModel model = area_model(surface, count);
  const std::vector<Vector3> seeds = start_seeds(model, count, Execution(1));
  // Against the integral of the density over the caps, by a lattice of its own.
  const std::vector<Vector3> lattice = fibonacci_lattice(20000);
  const std::vector<double> densities = model.number_densities(lattice, Execution(1));
  double inside = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    all += densities[i];
    if (std::abs(lattice[i].x()) > 0.5) inside += densities[i];
  }
  double found = 0.0;
  for (const Vector3& u : seeds) found += std::abs(u.x()) > 0.5 ? 1.0 / count : 0.0;
  EXPECT_GT(inside / all, 0.6);  // half on an even lattice
  // Half a ring of cells at each rim.
  EXPECT_NEAR(found, inside / all, 0.01);
}

}  // namespace
}  // namespace wscvt
