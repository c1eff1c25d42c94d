// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/space_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/pi.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/harmonic_map.h"
#include "wscvt/surface/mapped_surface.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/tessellation/power_cells.h"

namespace wscvt {
namespace {

const Vector3 semi_axes(1.3, 0.9, 0.7);

/// With vertices on the ellipsoid, along rays through those of a sphere.
IndexedMesh ellipsoid_mesh() {
  IndexedMesh mesh = test::sphere(4);
  const Ellipsoid surface(semi_axes);
  for (Vector3& p : mesh.points) p *= surface.radius(p);
  return mesh;
}

std::vector<double> densities_of(const IndexedMesh& mesh, Weighting weighting,
                                 int node_count = 1000, double alpha = 1.0, double exponent = 0.5) {
  WeightingOptions options;
  options.kind = weighting;
  options.curvature_alpha = alpha;
  options.adaptive_exponent = exponent;
  constexpr int rings = 2;
  return densities_in_space(mesh, quadric_fit_curvatures(mesh, rings, Execution(1)), options,
                            node_count);
}

/// The ellipsoid over the sphere that it was stretched from: coordinates of degree 1, but for the
/// chords of its faces.
MappedSurface stretched_ball() {
  const IndexedMesh ball = test::sphere(4);
  return MappedSurface(test::scaled(ball, semi_axes), ball.points, Execution(1));
}

double spread(const std::vector<double>& densities) {
  const auto [low, high] = std::minmax_element(densities.begin(), densities.end());
  return *high / *low;
}

TEST(SpaceWeights, WithoutCurvatureAreTheSameEverywhere) {
  for (const Weighting weighting :
       {Weighting::Constant, Weighting::RadialDistance, Weighting::Area}) {
    EXPECT_EQ(weighting_in_space(weighting), Weighting::Area);
    EXPECT_TRUE(densities_of(ellipsoid_mesh(), weighting).empty());
  }
  for (const Weighting weighting : {Weighting::Curvature, Weighting::ErrorAdaptive}) {
    EXPECT_EQ(weighting_in_space(weighting), weighting);
  }
}

TEST(SpaceWeights, TakeTheCurvatureOfTheSourceAskedFor) {
  const MappedSurface surface = stretched_ball();
  const std::vector<Vector3>& points = surface.mesh().points;
  WeightingOptions options;
  options.kind = Weighting::Curvature;
  const HarmonicMap map = fit_harmonic_map(surface, 6, Execution(1)).map;
  const std::vector<PrincipalCurvatures> series =
      curvatures_in_space(surface, &map, options, Execution(2));
  ASSERT_EQ(series.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 u = points[i].normalized();
    RadialJet jet;
    Ellipsoid(semi_axes).evaluate(&u, 1, Derivatives::Second, &jet);
    const PrincipalCurvatures k = principal_curvatures(jet, u);
    // Chords of 1/20 of a radius lie 1/3200 of it inside, which harmonics up to degree 6 follow
    // with second derivatives up to 42 times as large: 1.3 %.
    EXPECT_NEAR(series[i].maximum / k.maximum, 1.0, 0.013);
    EXPECT_NEAR(series[i].minimum / k.minimum, 1.0, 0.013);
  }
  options.curvature_source = CurvatureSource::QuadricFit;
  const std::vector<PrincipalCurvatures> quadrics =
      quadric_fit_curvatures(surface.mesh(), 2, Execution(1));
  for (const Weighting kind : {Weighting::Curvature, Weighting::ErrorAdaptive}) {
    options.kind = kind;
    const std::vector<PrincipalCurvatures> read =
        curvatures_in_space(surface, nullptr, options, Execution(2));
    ASSERT_EQ(read.size(), quadrics.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].maximum, quadrics[i].maximum);
      EXPECT_EQ(read[i].minimum, quadrics[i].minimum);
    }
    options.curvature_source = CurvatureSource::Series;  // of no meaning to the second
  }
  options.kind = Weighting::RadialDistance;
  EXPECT_TRUE(curvatures_in_space(surface, nullptr, options, Execution(1)).empty());
}

TEST(SpaceWeights, AMapWithoutANormalCountsAsFlat) {
  // Of degree 0 all directions have one point.
  WeightingOptions options;
  options.kind = Weighting::Curvature;
  const HarmonicMap point({{{1.0}, {2.0}, {3.0}}});
  for (const PrincipalCurvatures& k :
       curvatures_in_space(stretched_ball(), &point, options, Execution(1))) {
    EXPECT_EQ(k.maximum, 0.0);
    EXPECT_EQ(k.minimum, 0.0);
  }
}

TEST(SpaceWeights, ErrorAdaptiveIsThePowerOfTheCurvature) {
  const IndexedMesh mesh = ellipsoid_mesh();
  const std::vector<double> areas = vertex_areas(mesh);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  for (const double exponent : {0.5, 1.0}) {
    SCOPED_TRACE(exponent);
    const std::vector<double> densities =
        densities_of(mesh, Weighting::ErrorAdaptive, 1000, 1.0, exponent);
    ASSERT_EQ(densities.size(), mesh.points.size());
    for (std::size_t i = 0; i < densities.size(); ++i) {
      const Vector3 u = mesh.points[i].normalized();
      RadialJet jet;
      Ellipsoid(semi_axes).evaluate(&u, 1, Derivatives::Second, &jet);
      const PrincipalCurvatures k = principal_curvatures(jet, u);
      const double rms = std::sqrt(0.5 * (k.maximum * k.maximum + k.minimum * k.minimum));
      const double expected = std::pow(rms * std::sqrt(area / (4.0 * pi)), exponent);
      // A quadric over two rings and the mean over a ring each cost a per cent at the ends.
      EXPECT_NEAR(densities[i] / expected, 1.0, 0.05) << mesh.points[i].transpose();
    }
  }
}

TEST(SpaceWeights, CurvatureHasTheMeanAndTheDeviationOfEquation11) {
  const IndexedMesh mesh = ellipsoid_mesh();
  const std::vector<double> areas = vertex_areas(mesh);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const std::vector<double> densities = densities_of(mesh, Weighting::Curvature);
  const std::vector<double> reversed = densities_of(mesh, Weighting::Curvature, 1000, -1.0);
  ASSERT_EQ(densities.size(), mesh.points.size());
  double mean = 0.0;
  double squares = 0.0;
  std::size_t sharpest = 0;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    // Cell = 1 + 3.118 w / 4 pi of the mean one, w = 4 x; nothing is clipped here.
    const double x = (1.0 / densities[i] - 1.0) * 4.0 * pi / (4.0 * cell_area_per_weight);
    mean += areas[i] / area * x;
    squares += areas[i] / area * x * x;
    EXPECT_NEAR(1.0 / reversed[i] - 1.0, 1.0 - 1.0 / densities[i], 1e-12);
    if (densities[i] > densities[sharpest]) sharpest = i;
  }
  EXPECT_NEAR(mean, 0.0, 1e-12);
  EXPECT_NEAR(std::sqrt(squares), 1.0 / 3.0, 1e-12);
  // The ends of the longest axis bend most.
  EXPECT_GT(std::abs(mesh.points[sharpest].x()), 1.2);
}

TEST(SpaceWeights, CurvatureNeverWantsACellOfNothing) {
  for (const double alpha : {3.0, -3.0}) {
    const std::vector<double> densities =
        densities_of(ellipsoid_mesh(), Weighting::Curvature, 1000, alpha);
    // x is clipped at 0.9, which leaves 0.107 of the mean cell and makes at most 1.893.
    const double most = cell_area_per_weight * 3.6 / (4.0 * pi);
    const auto [low, high] = std::minmax_element(densities.begin(), densities.end());
    EXPECT_LE(*high, 1.0 / (1.0 - most) * (1.0 + 1e-12));
    EXPECT_GE(*low, 1.0 / (1.0 + most) * (1.0 - 1e-12));
    EXPECT_GT(spread(densities), 6.0);
  }
}

TEST(SpaceWeights, DoNotDependOnTheScaleOrTheOrder) {
  const IndexedMesh mesh = test::lumpy(3);
  for (const Weighting weighting : {Weighting::Curvature, Weighting::ErrorAdaptive}) {
    const std::vector<double> densities = densities_of(mesh, weighting);
    for (const double scale : {1e-6, 1e6}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(weighting) << " " << scale);
      const std::vector<double> scaled =
          densities_of(test::scaled(mesh, Vector3::Constant(scale)), weighting);
      ASSERT_EQ(scaled.size(), densities.size());
      for (std::size_t i = 0; i < scaled.size(); ++i) EXPECT_NEAR(scaled[i], densities[i], 1e-9);
    }
  }
}

TEST(SpaceWeights, CurvatureFinerThanTheCellsIsSmoothedAway) {
  // Waves of a twelfth of the radius, as small as six edges, along z.
  IndexedMesh rippled = test::sphere(5);
  for (Vector3& p : rippled.points) p *= 1.0 + 0.002 * std::sin(30.0 * p.z());
  for (const Weighting weighting : {Weighting::Curvature, Weighting::ErrorAdaptive}) {
    SCOPED_TRACE(static_cast<int>(weighting));
    EXPECT_LT(spread(densities_of(rippled, weighting, 50)) - 1.0,
              0.5 * (spread(densities_of(rippled, weighting, 20000)) - 1.0));
  }
}

TEST(SpaceWeights, ErrorAdaptiveLeavesNodesOnFlatFaces) {
  // Faces of a cube have no curvature: there the floor counts, 0.3 of the median or, as here where
  // more than half is flat, 0.01 in equivalent radii.
  const IndexedMesh cube = test::subdivided(test::box(1, 1, 1), 5);
  const std::vector<double> densities =
      densities_of(cube, Weighting::ErrorAdaptive, 20000, 1.0, 1.0);
  const double least = *std::min_element(densities.begin(), densities.end());
  EXPECT_NEAR(least, 0.01, 1e-12);
  EXPECT_GT(spread(densities), 100.0);
}

TEST(SpaceWeights, CurvatureCountsFlatFacesAsBentALittle) {
  // The logarithm of nothing would be no number.
  const IndexedMesh cube = test::subdivided(test::box(1, 1, 1), 4);
  const std::vector<double> densities = densities_of(cube, Weighting::Curvature, 20000);
  ASSERT_EQ(densities.size(), cube.points.size());
  std::size_t flat = 0;
  const double least = *std::min_element(densities.begin(), densities.end());
  for (const double density : densities) {
    ASSERT_TRUE(std::isfinite(density));
    flat += density < least * (1.0 + 1e-9) ? 1U : 0U;
  }
  EXPECT_GT(flat, densities.size() / 3);
  EXPECT_LT(flat, densities.size());
}

TEST(SpaceWeights, OfASphereAreNearlyTheSameEverywhere) {
  // The icosahedron shows through the quadrics.
  EXPECT_LT(spread(densities_of(test::sphere(4), Weighting::ErrorAdaptive)), 1.01);
}

TEST(SpaceWeights, RefuseOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const IndexedMesh mesh = test::sphere(1);
  EXPECT_ERROR(densities_of(mesh, Weighting::Curvature, 100, 3.5), InvalidInput);
  EXPECT_ERROR(densities_of(mesh, Weighting::Curvature, 100, nan), InvalidInput);
  EXPECT_ERROR(densities_of(mesh, Weighting::ErrorAdaptive, 100, 1.0, 1.6), InvalidInput);
  WeightingOptions curvature;
  curvature.kind = Weighting::Curvature;
  EXPECT_ERROR(densities_in_space(mesh, {}, curvature, 100), InvalidInput);
  EXPECT_ERROR(curvatures_in_space(stretched_ball(), nullptr, curvature, Execution(1)),
               InvalidInput);
}

}  // namespace
}  // namespace wscvt
