// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "support/expect_error.h"
#include "support/seed_models.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

using test::ellipsoid;
using test::model_of;

std::vector<double> weights_of(const SurfaceSeedModel& model, const std::vector<Vector3>& seeds) {
  std::vector<double> weights;
  model.weights(seeds, Execution(1), weights);
  return weights;
}

double largest_curvature(const RadialSurface& surface, const Vector3& u) {
  RadialJet jet;
  surface.evaluate(&u, 1, Derivatives::Second, &jet);
  const PrincipalCurvatures k = principal_curvatures(jet, u);
  return std::max(std::abs(k.maximum), std::abs(k.minimum));
}

TEST(Weights, RadialDistanceIsEquation10) {
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::RadialDistance);
  const std::vector<Vector3> seeds = fibonacci_lattice(1000);
  const std::vector<double> weights = weights_of(model, seeds);
  const double area = integrate(ellipsoid(), 60, Execution(1)).area;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double r = ellipsoid().radius(seeds[i]);
    // The table of 128 rows resolves this ellipsoid to 1e-6; the quadrature of S over it to 1e-4.
    EXPECT_NEAR(weights[i] / (area / (1000.0 * pi * r * r)), 1.0, 2e-4);
  }
}

TEST(Weights, AreaGivesEverySeedTheSameSurface) {
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Area);
  const std::vector<Vector3> seeds = fibonacci_lattice(500);
  const std::vector<double> weights = weights_of(model, seeds);
  const double area = integrate(ellipsoid(), 60, Execution(1)).area;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    RadialJet jet;
    ellipsoid().evaluate(&seeds[i], 1, Derivatives::First, &jet);
    EXPECT_NEAR(cell_area_per_weight * weights[i] * area_element(jet) / (area / 500.0), 1.0, 2e-4);
  }
}

TEST(Weights, CurvatureGivesSharpPlacesSmallerWeights) {
  const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Curvature);
  const std::vector<Vector3> seeds = fibonacci_lattice(1000);
  const std::vector<double> weights = weights_of(model, seeds);
  const auto mean = std::accumulate(weights.begin(), weights.end(), 0.0) / 1000.0;
  // x has mean 0 and deviation 1/3 over the seeds (eq. 11), and nothing is clipped here.
  double squares = 0.0;
  for (const double w : weights) squares += w * w;
  EXPECT_NEAR(mean, 0.0, 1e-16);
  EXPECT_NEAR(std::sqrt(squares / 999.0), 4.0 / 1000.0 / 3.0, 1e-12);
  std::vector<std::size_t> order(seeds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return largest_curvature(ellipsoid(), seeds[i]) < largest_curvature(ellipsoid(), seeds[j]);
  });
  EXPECT_GT(weights[order.front()], weights[order[500]]);
  EXPECT_GT(weights[order[500]], weights[order.back()]);
  const std::vector<double> reversed =
      weights_of(model_of(ellipsoid(), Weighting::Curvature, 1000, -1.0), seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i) EXPECT_NEAR(reversed[i], -weights[i], 1e-18);
}

TEST(Weights, CurvatureNeverWantsACellOfNothing) {
  // On an even lattice C is the mean cell: 3.118 w + C stays above 0 however large alpha is.
  for (const double alpha : {1.0, 3.0, -3.0}) {
    SCOPED_TRACE(alpha);
    const SurfaceSeedModel model = model_of(ellipsoid(), Weighting::Curvature, 1000, alpha);
    for (const double w : weights_of(model, fibonacci_lattice(1000))) {
      ASSERT_LT(cell_area_per_weight * std::abs(w), 4.0 * pi / 1000.0);
    }
  }
}

TEST(Weights, NoCellIsWantedSmallerThanATwentiethOfTheMean) {
  // At the ends of a needle eq. 10 wants less than nothing.
  const Ellipsoid needle(Vector3(6.0, 1.0, 1.0));
  const SurfaceSeedModel model = model_of(needle, Weighting::RadialDistance);
  const SphereQuadrature quadrature = gauss_legendre_sphere(100);
  const double mean = 1000.0 / (4.0 * pi);
  double count = 0.0;
  const std::vector<double> densities = model.number_densities(quadrature.directions, Execution(1));
  for (std::size_t i = 0; i < densities.size(); ++i) {
    ASSERT_LE(densities[i], 20.0 * mean * (1.0 + 1e-12));
    count += quadrature.weights[i] * densities[i];
  }
  EXPECT_NEAR(model.number_densities({Vector3::UnitX()}, Execution(1)).front(), 20.0 * mean,
              1e-9 * mean);
  // The kink where the bound sets in costs the two quadratures a per cent.
  EXPECT_NEAR(count, 1000.0, 10.0);
}

TEST(Weights, CurvatureFinerThanTheCellsIsSmoothedAway) {
  // Waves of 12 degrees on a ball change its curvature by a few times its own. Cells of 20 degrees
  // see their mean, cells of 2 degrees see each wave.
  std::vector<double> coefficients(31 * 31, 0.0);
  coefficients[0] = std::sqrt(4.0 * pi);
  coefficients[30 * 30 + 30 + 17] = 0.01;
  const HarmonicSurface rippled(coefficients);
  // On the equator the waves are equally high.
  std::vector<Vector3> equator;
  for (int i = 0; i < 360; ++i) {
    equator.emplace_back(std::cos(i * pi / 180.0), std::sin(i * pi / 180.0), 0.0);
  }
  const auto spread = [&](int nodes) {
    const std::vector<double> densities =
        model_of(rippled, Weighting::Curvature, nodes).number_densities(equator, Execution(1));
    const auto [low, high] = std::minmax_element(densities.begin(), densities.end());
    return *high / *low;
  };
  EXPECT_LT(spread(100), 1.05);
  EXPECT_GT(spread(10000), 1.3);
}

TEST(Weights, CurvatureOnASphereLeavesAllSeedsEqual) {
  const Ellipsoid sphere(Vector3(2.0, 2.0, 2.0));
  const std::vector<Vector3> seeds = fibonacci_lattice(100);
  for (const double w : weights_of(model_of(sphere, Weighting::Curvature, 100), seeds)) {
    EXPECT_EQ(w, 0.0);
  }
}

TEST(Weights, WantedDensitiesAddUpToTheNodeCount) {
  const SphereQuadrature quadrature = gauss_legendre_sphere(60);
  for (const Weighting weighting :
       {Weighting::Constant, Weighting::RadialDistance, Weighting::Curvature, Weighting::Area}) {
    SCOPED_TRACE(static_cast<int>(weighting));
    const SurfaceSeedModel model = model_of(ellipsoid(), weighting, 800);
    const std::vector<double> densities =
        model.number_densities(quadrature.directions, Execution(1));
    double count = 0.0;
    for (std::size_t i = 0; i < densities.size(); ++i)
      count += quadrature.weights[i] * densities[i];
    EXPECT_NEAR(count, 800.0, 0.8);
  }
}

TEST(Weights, DoNotDependOnTheScaleOfTheSurface) {
  const std::vector<Vector3> seeds = fibonacci_lattice(300);
  for (const double scale : {1e-6, 1e6}) {
    const Ellipsoid scaled(scale * Vector3(1.3, 0.9, 0.7));
    for (const Weighting weighting :
         {Weighting::RadialDistance, Weighting::Curvature, Weighting::Area}) {
      SCOPED_TRACE(testing::Message() << scale << " " << static_cast<int>(weighting));
      const std::vector<double> a = weights_of(model_of(ellipsoid(), weighting), seeds);
      const std::vector<double> b = weights_of(model_of(scaled, weighting), seeds);
      for (std::size_t i = 0; i < seeds.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
    }
  }
}

TEST(Weights, RefusesOptionsOutOfRange) {
  const auto expect_refused = [](int nodes, double alpha) {
    WeightingOptions options;
    options.curvature_alpha = alpha;
    test::expect_error(ErrorCode::InvalidInput,
                       [&] { SurfaceSeedModel(ellipsoid(), options, nodes, Execution(1)); });
  };
  expect_refused(3, 1.0);
  for (const double alpha : {3.5, -3.5, std::numeric_limits<double>::quiet_NaN()}) {
    expect_refused(100, alpha);
  }
}

}  // namespace

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
