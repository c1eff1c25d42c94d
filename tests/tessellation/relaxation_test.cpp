// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "support/expect_error.h"
#include "support/seed_models.h"
#include "support/seeds.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {
namespace {

using test::ellipsoid;
using test::model_of;

double edge_variation(const RelaxationResult& result) {
  IndexedMesh mesh;
  for (const Vector3& u : result.seeds) mesh.points.push_back(ellipsoid().radius(u) * u);
  mesh.triangles = result.triangulation.triangles();
  return measure_quality(mesh).edge_variation;
}

class EveryWeighting : public testing::TestWithParam<Weighting> {};

TEST_P(EveryWeighting, ConvergesToCellsOfTheWantedSize) {
  const SurfaceSeedModel model = model_of(ellipsoid(), GetParam(), 500);
  const RelaxationOptions options;
  const RelaxationResult result = relax(fibonacci_lattice(500), model, options, Execution(1));
  EXPECT_EQ(result.report.outcome, RelaxationOutcome::Converged);
  EXPECT_EQ(result.report.weight_scale, 1.0);
  ASSERT_EQ(result.report.history.size(), static_cast<std::size_t>(result.report.iterations) + 1);
  EXPECT_LT(result.report.history.back().displacement, options.displacement_tolerance);
  EXPECT_LT(result.report.history.back().area_spread, options.area_tolerance);
  ASSERT_EQ(result.seeds.size(), 500U);
  for (const Vector3& u : result.seeds) EXPECT_NEAR(u.norm(), 1.0, 1e-15);
  // The law "area = 3.118 w + C" in its consequence: cells follow the wanted density. 3 times the
  // tolerance of the spread, since the density's own table and the law's C are approximate.
  const std::vector<double> wanted = model.number_densities(result.seeds, Execution(1));
  double mean_square = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    total += result.cell_areas[i];
    mean_square += std::pow(result.cell_areas[i] * wanted[i] - 1.0, 2) / 500.0;
  }
  EXPECT_LT(std::sqrt(mean_square), 0.21);
  EXPECT_NEAR(total / (4.0 * pi), 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Relaxation, EveryWeighting,
                         testing::Values(Weighting::Constant, Weighting::RadialDistance,
                                         Weighting::Curvature, Weighting::Area));

TEST(Relaxation, MomentumWithRestartsSparesMostOfTheSteps) {
  // Both starts together take 333 steps with momentum and 1148 without.
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Area, 300);
  RelaxationOptions options;
  options.displacement_tolerance = 1e-5;
  int steps = 0;
  for (const auto& start : {fibonacci_lattice(300), random_directions(300, test::announced(20))}) {
    steps += relax(start, model, options, Execution(1)).report.iterations;
  }
  EXPECT_LT(steps, 500);
}

TEST(Relaxation, RandomStartConvergesToo) {
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Area, 300);
  const RelaxationResult result =
      relax(random_directions(300, test::announced(20)), model, RelaxationOptions(), Execution(1));
  EXPECT_EQ(result.report.outcome, RelaxationOutcome::Converged);
  EXPECT_LT(edge_variation(result), 0.1);
}

TEST(Relaxation, SmallestTessellationsAreThePolyhedra) {
  const Ellipsoid sphere(Vector3(1.0, 1.0, 1.0));
  WeightingOptions weighting;
  weighting.kind = Weighting::Constant;
  const SurfaceSeedModel model(sphere, weighting, 4, Execution(1));
  RelaxationOptions options;
  options.displacement_tolerance = 1e-9;
  const auto smallest_and_largest = [&](int count) {
    const RelaxationResult result = relax(fibonacci_lattice(count), model, options, Execution(1));
    IndexedMesh mesh{result.seeds, result.triangulation.triangles()};
    const Statistics edges = measure_quality(mesh).edge_length;
    return std::make_pair(edges.minimum, edges.maximum);
  };
  // Edge lengths of the regular tetrahedron, octahedron and icosahedron in the unit sphere.
  EXPECT_NEAR(smallest_and_largest(4).first, std::sqrt(8.0 / 3.0), 1e-6);
  EXPECT_NEAR(smallest_and_largest(4).second, std::sqrt(8.0 / 3.0), 1e-6);
  EXPECT_NEAR(smallest_and_largest(6).first, std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(smallest_and_largest(12).second, 1.0514622242382672, 1e-6);
}

TEST(Relaxation, ImpossibleWeightsAreDampedUntilEverySeedHasItsCell) {
  class Wild : public SeedModel {
   public:
    void weights(const std::vector<Vector3>& seeds, const Execution&,
                 std::vector<double>& result) const override {
      result.clear();
      for (const Vector3& u : seeds) result.push_back(u.x() > 0.0 ? 0.3 : -0.3);
    }
  };
  RelaxationOptions options;
  options.maximum_iterations = 5;
  const RelaxationResult result = relax(fibonacci_lattice(300), Wild(), options, Execution(1));
  EXPECT_LT(result.report.weight_scale, 1.0);
  EXPECT_EQ(result.triangulation.triangles().size(), 596U);
  // What is left of the differences still makes the cells of one half larger: where the halves
  // meet. Of a lattice without weights either half has 2 pi to some thousandths.
  options.maximum_iterations = 0;
  const RelaxationResult start = relax(fibonacci_lattice(300), Wild(), options, Execution(1));
  double half = 0.0;
  for (std::size_t i = 0; i < start.seeds.size(); ++i) {
    if (start.seeds[i].x() > 0.0) half += start.cell_areas[i];
  }
  EXPECT_GT(half, 1.02 * 2.0 * pi);
}

TEST(Relaxation, StoppingAtTheLimitIsAFieldNotAnError) {
  RelaxationOptions options;
  options.maximum_iterations = 0;
  const RelaxationResult result = relax(
      fibonacci_lattice(50), model_of(ellipsoid(), Weighting::Area, 50), options, Execution(1));
  EXPECT_EQ(result.report.outcome, RelaxationOutcome::IterationLimit);
  EXPECT_EQ(result.report.iterations, 0);
  EXPECT_EQ(result.seeds, fibonacci_lattice(50));
}

TEST(Relaxation, SettlesWhereTheAreasCannotBeWhatIsAskedFor) {
  // No tessellation has cells equal to nine digits.
  RelaxationOptions options;
  options.area_tolerance = 1e-9;
  const RelaxationResult result = relax(
      fibonacci_lattice(50), model_of(ellipsoid(), Weighting::Area, 50), options, Execution(1));
  EXPECT_EQ(result.report.outcome, RelaxationOutcome::Settled);
  EXPECT_LT(result.report.history.back().displacement, 0.01 * options.displacement_tolerance);
  EXPECT_GT(result.report.history.back().area_spread, options.area_tolerance);
}

TEST(Relaxation, SameBytesOnAnyNumberOfThreads) {
  RelaxationOptions options;
  options.maximum_iterations = 8;
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::RadialDistance, 12000);
  const auto run = [&](int threads) {
    return relax(fibonacci_lattice(12000), model, options, Execution(threads));
  };
  const RelaxationResult one = run(1);
  const RelaxationResult three = run(3);
  EXPECT_EQ(one.seeds, three.seeds);
  EXPECT_EQ(one.cell_areas, three.cell_areas);
  EXPECT_EQ(one.triangulation.triangles(), three.triangulation.triangles());
}

TEST(Relaxation, ProgressCancels) {
  int calls = 0;
  const Execution execution(1, [&](double, const std::string&) { return ++calls < 3; });
  test::expect_error(ErrorCode::Cancelled, [&] {
    relax(fibonacci_lattice(200), model_of(ellipsoid(), Weighting::Area, 200), {}, execution);
  });
}

TEST(Relaxation, RefusesSeedsThatDoNotSurroundTheCentre) {
  std::vector<Vector3> seeds = fibonacci_lattice(50);
  for (Vector3& u : seeds) u.z() = std::abs(u.z());
  EXPECT_ERROR(relax(seeds, model_of(ellipsoid(), Weighting::Area, 50), {}, Execution(1)),
               NumericalFailure);
}

TEST(Relaxation, RefusesThreeSeeds) {
  EXPECT_ERROR(
      relax(fibonacci_lattice(3), model_of(ellipsoid(), Weighting::Area, 50), {}, Execution(1)),
      InvalidInput);
}

}  // namespace

namespace {

/// The step at which a watch ends a relaxation with these displacements; `limit` if it does not.
template <class Watch, class Displacement>
int end_of(bool (Watch::*ends_at)(double), const Displacement& displacement, int limit) {
  Watch watch;
  for (int step = 1; step < limit; ++step) {
    if ((watch.*ends_at)(displacement(step))) return step;
  }
  return limit;
}

int stall(const std::function<double(int)>& displacement) {
  return end_of(&StallWatch::stalled_at, displacement, 5000);
}

TEST(StallWatch, EndsWhatNoLongerGains) {
  // The first fifty steps are the best; three more without a gain end it.
  EXPECT_EQ(stall([](int) { return 0.05; }), 200);
  // So do displacements that go up and down about a mean, or up.
  EXPECT_EQ(stall([](int step) { return 0.05 + 0.04 * (step % 2); }), 200);
  EXPECT_EQ(stall([](int step) { return 0.01 * step; }), 200);
  // One that fell to a floor at its 100th step: the mean of the third fifty is the best.
  EXPECT_EQ(stall([](int step) { return std::max(0.05 * std::exp(-0.05 * step), 3e-4); }), 300);
}

TEST(StallWatch, WaitsForWhatStillGains) {
  // A tenth in fifty steps is a gain; a twentieth is the least that is.
  EXPECT_EQ(stall([](int step) { return std::pow(0.9, step / 50.0); }), 5000);
  EXPECT_EQ(stall([](int step) { return std::pow(0.94, step / 50.0); }), 5000);
  // Gains below a twentieth add up: against the best, not against the fifty before.
  EXPECT_EQ(stall([](int step) { return std::pow(0.98, step / 50.0); }), 5000);
  EXPECT_LT(stall([](int step) { return std::pow(0.99, step / 50.0); }), 5000);
  // A rest of a hundred steps is not the end.
  EXPECT_EQ(stall([](int step) { return std::pow(0.5, step / 150); }), 5000);
}

TEST(Momentum, GrowsTowardsOneAndIsDroppedUphill) {
  Momentum momentum;
  EXPECT_EQ(momentum.carry(false), 0.0);
  double last = 0.0;
  for (int step = 0; step < 100; ++step) {
    const double share = momentum.carry(false);
    EXPECT_GT(share, last);
    EXPECT_LT(share, 1.0);
    last = share;
  }
  // Nesterov's weights grow by a half a step, so shares come to 1 - 3 / (step + 3).
  EXPECT_NEAR(last, 1.0 - 3.0 / 103.0, 2e-3);
  EXPECT_EQ(momentum.carry(true), 0.0);
}

}  // namespace
}  // namespace wscvt
