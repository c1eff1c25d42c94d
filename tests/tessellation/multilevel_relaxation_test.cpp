// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/multilevel_relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "support/added_points.h"
#include "support/expect_error.h"
#include "support/seed_models.h"
#include "support/seeds.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {
namespace {

using test::ellipsoid;
using test::model_of;

RelaxationResult relaxed(int count, Weighting weighting, RelaxationMetric metric, int threads = 1,
                         const MultilevelOptions& levels = {}) {
  const SurfaceSeedModel model = model_of(ellipsoid(), weighting, count);
  RelaxationOptions options;
  options.metric = metric;
  return relax_multilevel(fibonacci_lattice(level_sizes(count, levels.coarsest_seeds).front()),
                          count, model, options, levels, Execution(threads));
}

MeshQuality quality(const RelaxationResult& result) {
  IndexedMesh mesh;
  for (const Vector3& u : result.seeds) mesh.points.push_back(ellipsoid().radius(u) * u);
  mesh.triangles = result.triangulation.triangles();
  return measure_quality(mesh);
}

TEST(MultilevelRelaxation, LevelsLeadToExactlyTheCount) {
  for (int count = 4; count < 3000; ++count) {
    const std::vector<int> sizes = level_sizes(count, 20);
    ASSERT_EQ(sizes.back(), count);
    ASSERT_TRUE(count < 74 ? sizes.size() == 1 : sizes.front() >= 20 && sizes.front() < 74);
    for (std::size_t k = 1; k < sizes.size(); ++k) {
      const int extra = sizes[k] - (4 * sizes[k - 1] - 6);
      ASSERT_TRUE(extra >= 0 && extra <= 3) << count;
    }
  }
}

TEST(MultilevelRelaxation, SeedsThatAreMissingAreAddedWhereThereIsMostRoom) {
  // Random seeds have triangles of all sizes. Nothing is moved, so the three seeds added stand
  // last.
  const int coarse = 50;
  const int count = 4 * coarse - 6 + 3;
  MultilevelOptions levels;
  levels.coarsest_seeds = coarse;
  RelaxationOptions options;
  options.maximum_iterations = 0;
  const RelaxationResult result = relax_multilevel(
      random_directions(coarse, test::announced(4)), count,
      model_of(ellipsoid(), Weighting::Constant, count), options, levels, Execution(1));
  ASSERT_EQ(static_cast<int>(result.seeds.size()), count);
  test::expect_room_about_the_last(result.seeds, 3);
}

TEST(MultilevelRelaxation, ConvergesWithTheExactCountForEveryWeightingAndMetric) {
  for (const auto metric : {RelaxationMetric::Sphere, RelaxationMetric::Surface}) {
    for (const auto weighting : {Weighting::Constant, Weighting::RadialDistance,
                                 Weighting::Curvature, Weighting::Area, Weighting::ErrorAdaptive}) {
      SCOPED_TRACE(testing::Message()
                   << static_cast<int>(weighting) << " " << static_cast<int>(metric));
      for (const int count : {1001, 1002, 1003}) {
        const RelaxationResult result = relaxed(count, weighting, metric);
        EXPECT_EQ(result.report.outcome, RelaxationOutcome::Converged);
        EXPECT_EQ(result.seeds.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(result.triangulation.triangles().size(), 2U * count - 4U);
        ASSERT_EQ(result.report.coarser_levels.size(), 1U);
        EXPECT_EQ(result.report.coarser_levels.front().outcome, RelaxationOutcome::Converged);
      }
    }
  }
}

TEST(MultilevelRelaxation, IsAsEvenAsOneLevelInFewerIterationsWithFewerDefects) {
  constexpr int count = 4000;
  const RelaxationResult levels = relaxed(count, Weighting::Area, RelaxationMetric::Surface);
  MultilevelOptions one_level;
  one_level.coarsest_seeds = count;
  const RelaxationResult single =
      relaxed(count, Weighting::Area, RelaxationMetric::Surface, 1, one_level);
  EXPECT_LT(levels.report.iterations, single.report.iterations / 2);
  // The level rule stops at 1e-3 of a cell; the two then differ by what is left to go.
  EXPECT_LT(quality(levels).edge_variation, 1.15 * quality(single).edge_variation);
  EXPECT_GT(quality(levels).valence_six_share, quality(single).valence_six_share);
}

TEST(MultilevelRelaxation, SameBytesOnAnyNumberOfThreads) {
  const RelaxationResult one = relaxed(9000, Weighting::Area, RelaxationMetric::Surface, 1);
  const RelaxationResult two = relaxed(9000, Weighting::Area, RelaxationMetric::Surface, 2);
  EXPECT_EQ(one.seeds, two.seeds);
  EXPECT_EQ(one.triangulation.triangles(), two.triangulation.triangles());
}

TEST(MultilevelRelaxation, RefusesAStartThatDoesNotFit) {
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Area, 1000);
  test::expect_error(ErrorCode::InvalidInput, [&] {
    relax_multilevel(fibonacci_lattice(300), 1000, model, {}, {}, Execution(1));
  });
  test::expect_error(ErrorCode::InvalidInput, [] { level_sizes(3, 20); });
  test::expect_error(ErrorCode::InvalidInput, [] { level_sizes(100, 3); });
}

TEST(MultilevelRelaxation, RefusesLevelsOutOfRange) {
  EXPECT_NO_THROW(check_multilevel_options({}));
  for (const int seeds : {3, 0, -1}) {
    MultilevelOptions fewest;
    fewest.coarsest_seeds = seeds;
    EXPECT_ERROR(check_multilevel_options(fewest), InvalidInput);
  }
  for (const double tolerance : {0.0, -1e-4, std::numeric_limits<double>::quiet_NaN()}) {
    MultilevelOptions coarsest;
    coarsest.coarsest_tolerance = tolerance;
    test::expect_error(ErrorCode::InvalidInput, [&] {
      relaxed(1000, Weighting::Area, RelaxationMetric::Sphere, 1, coarsest);
    });
    MultilevelOptions middle;
    middle.middle_tolerance = tolerance;
    test::expect_error(ErrorCode::InvalidInput, [&] {
      relaxed(1000, Weighting::Area, RelaxationMetric::Sphere, 1, middle);
    });
  }
}

TEST(MultilevelRelaxation, SaysWhichCoarserLevelsConverged) {
  // One iteration from a lattice is too few for the coarsest level.
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Area, 1000);
  RelaxationOptions options;
  options.maximum_iterations = 1;
  const RelaxationResult result =
      relax_multilevel(fibonacci_lattice(251), 1000, model, options, {}, Execution(1));
  ASSERT_EQ(result.report.coarser_levels.size(), 1U);
  EXPECT_EQ(result.report.coarser_levels.front().iterations, 1);
  EXPECT_EQ(result.report.coarser_levels.front().outcome, RelaxationOutcome::IterationLimit);
}

}  // namespace
}  // namespace wscvt
