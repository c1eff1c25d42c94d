// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/sphere_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "support/random_harmonics.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

HarmonicSurface lumpy_series() {
  std::vector<double> coefficients{3.5};
  for (const Vector3& u : random_directions(24, test::announced(4))) {
    coefficients.push_back(0.1 * u.x());
  }
  return HarmonicSurface(coefficients);
}

/// A map with terms up to degree 4 in every coordinate.
HarmonicMap bent_map() {
  std::array<std::vector<double>, 3> coefficients;
  for (std::size_t k = 0; k < 3; ++k) {
    coefficients[k].push_back(0.3);
    for (const Vector3& u : random_directions(24, test::announced(5 + k))) {
      coefficients[k].push_back(0.05 * u.x());
    }
  }
  coefficients[0][harmonic_index(1, 1)] -= 2.0;
  coefficients[1][harmonic_index(1, -1)] -= 2.0;
  coefficients[2][harmonic_index(1, 0)] += 2.0;
  return HarmonicMap(coefficients);
}

/// Jacobians and Hessians against central differences of x(p/|p|).
void expect_derivatives(const SphereSurface& surface, double step, double tolerance) {
  const auto jet_at = [&](const Vector3& p, Derivatives derivatives) {
    const Vector3 u = p.normalized();
    SurfaceJet jet;
    surface.evaluate_jets(&u, 1, derivatives, &jet);
    return jet;
  };
  for (const Vector3& u : random_directions(50, test::announced(9))) {
    const SurfaceJet jet = jet_at(u, Derivatives::Second);
    EXPECT_LT((jet.jacobian * u).norm(), 1e-12);
    for (int a = 0; a < 3; ++a) {
      const Vector3 ahead = u + step * Vector3::Unit(a);
      const Vector3 behind = u - step * Vector3::Unit(a);
      const Vector3 slope =
          (jet_at(ahead, Derivatives::None).position - jet_at(behind, Derivatives::None).position) /
          (2.0 * step);
      EXPECT_LT((jet.jacobian.col(a) - slope).norm(), tolerance);
      // The Jacobian of a degree-0 function scales with 1/|p|.
      const Matrix3 bend = (jet_at(ahead, Derivatives::First).jacobian / ahead.norm() -
                            jet_at(behind, Derivatives::First).jacobian / behind.norm()) /
                           (2.0 * step);
      for (int k = 0; k < 3; ++k) {
        EXPECT_LT(
            (jet.hessians[static_cast<std::size_t>(k)].col(a) - bend.row(k).transpose()).norm(),
            tolerance);
      }
    }
    // What is not asked for stays zero.
    const SurfaceJet plain = jet_at(u, Derivatives::None);
    EXPECT_EQ(plain.jacobian.norm(), 0.0);
    EXPECT_EQ(jet_at(u, Derivatives::First).hessians[1].norm(), 0.0);
  }
}

TEST(SphereSurface, DerivativesAreThoseOfThePosition) {
  // Differences of step 1e-5 err by 1e-10 of the third derivatives and by 1e-16 / 1e-5.
  const HarmonicSurface series = lumpy_series();
  expect_derivatives(series, 1e-5, 1e-7);
  expect_derivatives(bent_map(), 1e-5, 1e-7);
}

TEST(SphereSurface, AgreesWithTheRadialFormulas) {
  const HarmonicSurface series = lumpy_series();
  const std::vector<Vector3> u = random_directions(300, test::announced(12));
  const auto radial = series.jets(u, Derivatives::Second, Execution(1));
  const auto jets = series.surface_jets(u, Derivatives::Second, Execution(1));
  const auto positions = series.positions(u, Execution(2));
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_LT((positions[i] - jets[i].position).norm(), 1e-15);
    EXPECT_LT((jets[i].position - radial[i].radius * u[i]).norm(), 1e-15);
    EXPECT_NEAR(area_element(jets[i], u[i]), area_element(radial[i]), 1e-13);
    EXPECT_LT((surface_normal(jets[i], u[i]) - surface_normal(radial[i], u[i])).norm(), 1e-13);
    const PrincipalCurvatures a = principal_curvatures(jets[i], u[i]);
    const PrincipalCurvatures b = principal_curvatures(radial[i], u[i]);
    EXPECT_NEAR(a.maximum, b.maximum, 1e-10);
    EXPECT_NEAR(a.minimum, b.minimum, 1e-10);
  }
}

TEST(SphereSurface, IntegralsOfAnEllipsoid) {
  // Half axes 2, 1.5 and 1: not by its radius but as an affine image of the sphere.
  const Vector3 shift(0.3, -0.2, 0.1);
  const HarmonicMap ellipsoid = test::affine_map(Vector3(2.0, 1.5, 1.0), shift);
  const BodyIntegrals sums = body_integrals(ellipsoid, 60, Execution(2));
  EXPECT_NEAR(sums.volume, 4.0 * test::pi / 3.0 * 3.0, 1e-12);
  EXPECT_LT((sums.centroid - shift).norm(), 1e-12);
  const SurfaceIntegrals radial = integrate(Ellipsoid(Vector3(2.0, 1.5, 1.0)), Execution(1));
  EXPECT_NEAR(sums.area, radial.area, 1e-4 * radial.area);
  // Curvatures of the poles: a / b^2 and a / c^2.
  const Vector3 u = Vector3::UnitX();
  SurfaceJet jet;
  ellipsoid.evaluate_jets(&u, 1, Derivatives::Second, &jet);
  const PrincipalCurvatures curvatures = principal_curvatures(jet, u);
  EXPECT_NEAR(curvatures.maximum, 2.0, 1e-12);
  EXPECT_NEAR(curvatures.minimum, 2.0 / 2.25, 1e-12);
  EXPECT_LT((surface_normal(jet, u) - u).norm(), 1e-14);
  EXPECT_THROW(body_integrals(ellipsoid, 0, Execution(1)), Error);
}

TEST(SphereSurface, SameBytesOnAnyNumberOfThreadsAndInAnyCompany) {
  const HarmonicMap map = bent_map();
  const std::vector<Vector3> u = random_directions(3000, test::announced(14));
  const auto one = map.surface_jets(u, Derivatives::Second, Execution(1));
  const auto two = map.surface_jets(u, Derivatives::Second, Execution(2));
  const auto points = map.positions(u, Execution(2));
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_EQ(one[i].hessians, two[i].hessians);
    EXPECT_EQ(one[i].position, points[i]);
  }
  SurfaceJet alone;
  map.evaluate_jets(&u[17], 1, Derivatives::Second, &alone);
  EXPECT_EQ(alone.jacobian, one[17].jacobian);
}

/// A ball of radius 2 about (0.5, 0, 0), each point in its direction from there.
HarmonicMap shifted_ball() {
  return test::affine_map(Vector3::Constant(2.0), Vector3(0.5, 0.0, 0.0));
}

TEST(SphereSurface, ShapesOfAShiftedBallAreThoseOfTheFormula) {
  const HarmonicMap ball = shifted_ball();
  const std::vector<Vector3> directions = random_directions(50, test::announced(31));
  std::vector<LocalShape> shapes(directions.size());
  ball.evaluate_shapes(directions.data(), directions.size(), Derivatives::Second, shapes.data());
  const std::vector<double> distances = ball.distances(directions, Execution(2));
  const AreaElements read = area_elements(ball, directions, Execution(2));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double distance = (Vector3(0.5, 0.0, 0.0) + 2.0 * directions[i]).norm();
    // A few dozen operations on numbers of size 1.
    EXPECT_NEAR(shapes[i].distance, distance, 1e-13);
    EXPECT_NEAR(shapes[i].area_element, 4.0, 1e-13);
    EXPECT_NEAR(shapes[i].curvatures.maximum, 0.5, 1e-7);  // the root of what cancels to rounding
    EXPECT_NEAR(shapes[i].curvatures.minimum, 0.5, 1e-7);
    EXPECT_EQ(distances[i], shapes[i].distance);
    EXPECT_EQ(read.distances[i], shapes[i].distance);
    EXPECT_EQ(read.elements[i], shapes[i].area_element);
  }
  EXPECT_NEAR(surface_area(ball, 8, Execution(1)), 16.0 * test::pi, 1e-12);
}

TEST(SphereSurface, ShapesByRadiiAreThoseByCoordinates) {
  const HarmonicSurface series = lumpy_series();
  const std::vector<Vector3> directions = random_directions(50, test::announced(32));
  for (const Derivatives derivatives :
       {Derivatives::None, Derivatives::First, Derivatives::Second}) {
    std::vector<LocalShape> radial(directions.size());
    std::vector<LocalShape> usual(directions.size());
    series.evaluate_shapes(directions.data(), directions.size(), derivatives, radial.data());
    series.SphereSurface::evaluate_shapes(directions.data(), directions.size(), derivatives,
                                          usual.data());
    for (std::size_t i = 0; i < directions.size(); ++i) {
      EXPECT_NEAR(radial[i].distance, usual[i].distance, 1e-13);
      EXPECT_NEAR(radial[i].area_element, usual[i].area_element, 1e-12);
      // Two formulas, each with differences of numbers of size 1 and a root.
      EXPECT_NEAR(radial[i].curvatures.maximum, usual[i].curvatures.maximum, 1e-9);
      EXPECT_NEAR(radial[i].curvatures.minimum, usual[i].curvatures.minimum, 1e-9);
    }
  }
  EXPECT_NEAR(
      surface_area(series, 40, Execution(1)) / body_integrals(series, 40, Execution(1)).area, 1.0,
      1e-12);
}

}  // namespace
}  // namespace wscvt
