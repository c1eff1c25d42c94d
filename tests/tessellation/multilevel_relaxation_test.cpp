// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/multilevel_relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "support/expect_error.h"
#include "support/seed_models.h"
#include "support/seeds.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {
namespace {

/// Fails unless each of the last `added` points has it farther to the nearest other one than the
/// median has: they were put where there was room.
void expect_room_about_the_last(const std::vector<Vector3>& points, std::size_t added) {
  std::vector<double> nearest;
  for (const Vector3& p : points) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Vector3& q : points) {
      if (&p != &q) smallest = std::min(smallest, (p - q).norm());
    }
    nearest.push_back(smallest);
  }
  std::vector<double> sorted = nearest;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 1; k <= added; ++k) {
    EXPECT_GT(nearest[points.size() - k], sorted[points.size() / 2]);
  }
}

using test::ellipsoid;
using test::model_of;

RelaxationResult relaxed(int count, Weighting weighting, int threads = 1) {
  const SurfaceSeedModel model = model_of(ellipsoid(), weighting, count);
  return relax_multilevel(fibonacci_lattice(level_sizes(count).front()), count, model, {},
                          Execution(threads));
}

MeshQuality quality(const RelaxationResult& result) {
  IndexedMesh mesh;
  for (const Vector3& u : result.seeds) mesh.points.push_back(ellipsoid().radius(u) * u);
  mesh.triangles = result.triangulation.triangles();
  return measure_quality(mesh);
}

TEST(MultilevelRelaxation, LevelsLeadToExactlyTheCount) {
  for (int count = 4; count < 3000; ++count) {
    const std::vector<int> sizes = level_sizes(count);
    ASSERT_EQ(sizes.back(), count);
    ASSERT_TRUE(count < 494 ? sizes.size() == 1 : sizes.front() >= 125 && sizes.front() < 494);
    for (std::size_t k = 1; k < sizes.size(); ++k) {
      const int extra = sizes[k] - (4 * sizes[k - 1] - 6);
      ASSERT_TRUE(extra >= 0 && extra <= 3) << count;
    }
  }
}

TEST(MultilevelRelaxation, SeedsThatAreMissingAreAddedWhereThereIsMostRoom) {
  // Random seeds have triangles of all sizes. Nothing is moved, so the three seeds added stand
  // last.
  const int coarse = 125;
  const int count = 4 * coarse - 6 + 3;
  RelaxationOptions options;
  options.maximum_iterations = 0;
  const RelaxationResult result =
      relax_multilevel(random_directions(coarse, test::announced(4)), count,
                       model_of(ellipsoid(), Weighting::Constant, count), options, Execution(1));
  ASSERT_EQ(static_cast<int>(result.seeds.size()), count);
  expect_room_about_the_last(result.seeds, 3);
}

TEST(MultilevelRelaxation, ConvergesWithTheExactCountForEveryWeighting) {
  for (const auto& weighting : enumerators<Weighting>()) {
    SCOPED_TRACE(weighting.label);
    for (const int count : {1001, 1002, 1003}) {
      const RelaxationResult result = relaxed(count, weighting.value);
      EXPECT_EQ(result.report.outcome, RelaxationOutcome::Converged);
      EXPECT_EQ(result.seeds.size(), static_cast<std::size_t>(count));
      EXPECT_EQ(result.triangulation.triangles().size(), 2U * count - 4U);
      ASSERT_EQ(result.report.coarser_levels.size(), 1U);
      EXPECT_EQ(result.report.coarser_levels.front().outcome, RelaxationOutcome::Converged);
    }
  }
}

TEST(MultilevelRelaxation, IsAsEvenAsOneLevelInFewerIterationsWithFewerDefects) {
  constexpr int count = 4000;
  const RelaxationResult levels = relaxed(count, Weighting::Area);
  const RelaxationResult single = relax(
      fibonacci_lattice(count), model_of(ellipsoid(), Weighting::Area, count), {}, Execution(1));
  EXPECT_LT(levels.report.iterations, single.report.iterations / 2);
  // The level rule stops at 1e-3 of a cell; the two then differ by what is left to go.
  EXPECT_LT(quality(levels).edge_variation, 1.15 * quality(single).edge_variation);
  EXPECT_GT(quality(levels).valence_six_fraction, quality(single).valence_six_fraction);
}

TEST(MultilevelRelaxation, SameBytesOnAnyNumberOfThreads) {
  const RelaxationResult one = relaxed(9000, Weighting::Area, 1);
  const RelaxationResult two = relaxed(9000, Weighting::Area, 2);
  EXPECT_EQ(one.seeds, two.seeds);
  EXPECT_EQ(one.triangulation.triangles(), two.triangulation.triangles());
}

TEST(MultilevelRelaxation, RefusesAStartThatDoesNotFit) {
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Area, 1000);
  test::expect_error(ErrorCode::InvalidInput, [&] {
    relax_multilevel(fibonacci_lattice(300), 1000, model, {}, Execution(1));
  });
  test::expect_error(ErrorCode::InvalidInput, [] { level_sizes(3); });
}

TEST(MultilevelRelaxation, SaysWhichCoarserLevelsConverged) {
  // One iteration from a lattice is too few for the coarsest level.
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Area, 1000);
  RelaxationOptions options;
  options.maximum_iterations = 1;
  const RelaxationResult result =
      relax_multilevel(fibonacci_lattice(251), 1000, model, options, Execution(1));
  ASSERT_EQ(result.report.coarser_levels.size(), 1U);
  EXPECT_EQ(result.report.coarser_levels.front().iterations, 1);
  EXPECT_EQ(result.report.coarser_levels.front().outcome, RelaxationOutcome::IterationLimit);
}

}  // namespace
}  // namespace wscvt
