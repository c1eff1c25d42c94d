// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grains/ct_grain.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

std::vector<PrincipalCurvatures> curvatures(const IndexedMesh& mesh, int rings = 2) {
  return quadric_fit_curvatures(mesh, rings, Execution(1));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Principal curvatures of the ellipsoid with half axes `axes` at a point on it, from its Gaussian
/// and mean curvature (e.g. Harris, "Curvature of ellipsoids and other surfaces", 2006).
PrincipalCurvatures ellipsoid_curvatures(const Vector3& axes, const Vector3& point) {
  const Vector3 squares = axes.cwiseAbs2();
  const double support = point.cwiseQuotient(squares).squaredNorm();
  const double product = squares.prod();
  const double gauss = 1.0 / (product * support * support);
  const double mean =
      (squares.sum() - point.squaredNorm()) / (2.0 * product * std::pow(support, 1.5));
  const double deviation = std::sqrt(std::max(0.0, mean * mean - gauss));
  return {mean + deviation, mean - deviation};
}

/// Median relative errors of the larger and the smaller curvature.
std::array<double, 2> ellipsoid_errors(const IndexedMesh& mesh, const Vector3& axes, int rings) {
  const std::vector<PrincipalCurvatures> fitted = curvatures(mesh, rings);
  std::array<std::vector<double>, 2> errors;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const PrincipalCurvatures exact = ellipsoid_curvatures(axes, mesh.points[i]);
    errors[0].push_back(std::abs(fitted[i].maximum / exact.maximum - 1.0));
    errors[1].push_back(std::abs(fitted[i].minimum / exact.minimum - 1.0));
  }
  return {median(errors[0]), median(errors[1])};
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  for (const double radius : {1e-6, 1.0, 1e3}) {
    for (const PrincipalCurvatures& k :
         curvatures(test::scaled(test::sphere(4), Vector3::Constant(radius)))) {
      // A paraboloid through points up to two edges of 0.07 away, and the square root of the
      // difference of two nearly equal numbers.
      EXPECT_NEAR(k.maximum * radius, 1.0, 0.02);
      EXPECT_NEAR(k.minimum * radius, 1.0, 0.02);
    }
  }
}

TEST(Curvature, OfAnEllipsoidIsTheKnownOne) {
  // 10242 vertices on the surface itself. The prototype's median errors were 0.1 % and 0.4 %.
  const Vector3 axes(1.0, 0.7, 0.5);
  const IndexedMesh mesh = test::scaled(test::sphere(5), axes);
  const std::array<double, 2> one_ring = ellipsoid_errors(mesh, axes, 1);
  EXPECT_LT(one_ring[0], 0.002);
  EXPECT_LT(one_ring[1], 0.004);
  const std::array<double, 2> two_rings = ellipsoid_errors(mesh, axes, 2);
  EXPECT_LT(two_rings[0], 0.006);
  EXPECT_LT(two_rings[1], 0.010);
}

TEST(Curvature, ConvergesWithTheSquareOfTheEdge) {
  const Vector3 axes(1.0, 0.7, 0.5);
  const double coarse = ellipsoid_errors(test::scaled(test::sphere(4), axes), axes, 2)[0];
  const double fine = ellipsoid_errors(test::scaled(test::sphere(5), axes), axes, 2)[0];
  EXPECT_NEAR(coarse / fine, 4.0, 0.8);
}

TEST(Curvature, OfATorusChangesSign) {
  const int segments = 120;
  const IndexedMesh mesh = test::torus(3.0, 1.0, segments);
  const std::vector<PrincipalCurvatures> fitted = curvatures(mesh);
  for (int j = 0; j < segments; ++j) {
    const double cosine = std::cos(2.0 * test::pi * j / segments);
    const PrincipalCurvatures& k = fitted[static_cast<std::size_t>(j)];
    // On the outer side two rings reach 0.42: the next terms are a quarter of its square.
    EXPECT_NEAR(k.maximum, 1.0, 0.045);
    EXPECT_NEAR(k.minimum, cosine / (3.0 + cosine), 0.045);
  }
}

TEST(Curvature, ChangesSignWithTheOrientation) {
  IndexedMesh mesh = test::lumpy(3);
  const std::vector<PrincipalCurvatures> outward = curvatures(mesh);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  const std::vector<PrincipalCurvatures> inward = curvatures(mesh);
  for (std::size_t i = 0; i < outward.size(); ++i) {
    EXPECT_NEAR(inward[i].maximum, -outward[i].minimum, 1e-10);
    EXPECT_NEAR(inward[i].minimum, -outward[i].maximum, 1e-10);
  }
}

TEST(Curvature, TurnsMovesAndScalesWithTheMesh) {
  const IndexedMesh mesh = test::lumpy(3);
  const std::vector<PrincipalCurvatures> plain = curvatures(mesh);
  const IndexedMesh moved = test::transformed(mesh, 4.0 * test::random_rotation(test::announced(3)),
                                              Vector3(10.0, -20.0, 30.0));
  const std::vector<PrincipalCurvatures> turned = curvatures(moved);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    // Curvatures of order one from heights of 1e-3, which there carry 1e-15.
    EXPECT_NEAR(4.0 * turned[i].maximum, plain[i].maximum, 1e-9);
    EXPECT_NEAR(4.0 * turned[i].minimum, plain[i].minimum, 1e-9);
  }
}

TEST(Curvature, NeedsTwoRingsOnAScan) {
  const test::Grain grain = test::ellipsoid_grain();
  const IndexedMesh scan = test::ct_mesh_of_about(grain, 4000);
  // Of the formula, after its scaling to the volume of the unit sphere.
  const Vector3 axes = Vector3(1.0, 0.7, 0.5) / std::cbrt(0.35);
  const double one_ring = ellipsoid_errors(scan, axes, 1)[0];
  const double two_rings = ellipsoid_errors(scan, axes, 2)[0];
  EXPECT_LT(two_rings, 0.6 * one_ring);
  EXPECT_LT(two_rings, 0.4);
}

TEST(Curvature, IsFiniteWhereTheFitIsUnderDetermined) {
  for (const IndexedMesh& mesh :
       {test::tetrahedron(1.0), test::box(1, 1, 1), test::icosahedron()}) {
    for (const PrincipalCurvatures& k : curvatures(mesh, 1)) {
      EXPECT_TRUE(std::isfinite(k.maximum) && std::isfinite(k.minimum));
      EXPECT_GE(k.maximum, k.minimum);
      EXPECT_GT(k.maximum, 0.0);  // all corners are convex
    }
  }
  // All in one point.
  const IndexedMesh point{std::vector<Vector3>(4, Vector3(1, 2, 3)),
                          test::tetrahedron(1).triangles};
  for (const PrincipalCurvatures& k : curvatures(point)) EXPECT_EQ(k.maximum, 0.0);
}

TEST(Curvature, IsTheSameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(4);
  const std::vector<PrincipalCurvatures> one = quadric_fit_curvatures(mesh, 2, Execution(1));
  const std::vector<PrincipalCurvatures> three = quadric_fit_curvatures(mesh, 2, Execution(3));
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].maximum, three[i].maximum);
    EXPECT_EQ(one[i].minimum, three[i].minimum);
  }
}

TEST(Curvature, RefusesNoRings) {
  EXPECT_ERROR(curvatures(test::sphere(1), 0), InvalidInput);
  EXPECT_ERROR(curvatures(test::sphere(1), -1), InvalidInput);
}

}  // namespace
}  // namespace wscvt
