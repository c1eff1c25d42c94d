// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/radial_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

/// Sphere of radius R about `center`, |center| < R: a surface whose radius varies and whose every
/// measure is known. It keeps the default evaluate_radii.
class ShiftedSphere : public RadialSurface {
 public:
  ShiftedSphere(double radius, const Vector3& center) : radius_(radius), center_(center) {}

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override {
    for (std::size_t i = 0; i < count; ++i) {
      // r = p + sqrt(p^2 + q) with p = u . center, as a function of x without normalising.
      const Vector3& u = directions[i];
      const double p = u.dot(center_);
      const double q = radius_ * radius_ - center_.squaredNorm();
      const double root = std::sqrt(p * p + q);
      const Vector3 gradient = (1.0 + p / root) * center_;
      const Matrix3 hessian = q / (root * root * root) * center_ * center_.transpose();
      jets[i] = jet_from_extension(p + root, gradient, hessian, u);
      if (derivatives != Derivatives::Second) jets[i].hessian.setZero();
      if (derivatives == Derivatives::None) jets[i].gradient.setZero();
      ++calls;
    }
  }

  mutable std::atomic<int> calls{0};

 private:
  double radius_;
  Vector3 center_;
};

TEST(RadialSurface, ShiftedSphereHasTheCurvaturesAndNormalsOfASphere) {
  const Vector3 center(0.4, -0.3, 0.6);
  const ShiftedSphere surface(2.0, center);
  const std::vector<Vector3> u = random_directions(100, test::announced(1));
  const std::vector<RadialJet> jets = surface.jets(u, Derivatives::Second, Execution(1));
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vector3 expected_normal = (jets[i].radius * u[i] - center) / 2.0;
    EXPECT_NEAR((surface_normal(jets[i], u[i]) - expected_normal).norm(), 0.0, 1e-13);
    const PrincipalCurvatures k = principal_curvatures(jets[i], u[i]);
    EXPECT_NEAR(k.maximum, 0.5, 1e-13);
    EXPECT_NEAR(k.minimum, 0.5, 1e-13);
    // dA = r^2 dOmega / cos of the angle between normal and ray.
    EXPECT_NEAR(area_element(jets[i]), jets[i].radius * jets[i].radius / expected_normal.dot(u[i]),
                1e-12);
  }
}

TEST(RadialSurface, JetFromExtensionDoesNotDependOnTheExtension) {
  // f = x y z |x|^k are all the same on the sphere.
  const Vector3 u = Vector3(0.5, -0.7, 0.3).normalized();
  const double f = u.prod();
  const Vector3 first = f * u.cwiseInverse();
  Matrix3 second;
  second << 0.0, u.z(), u.y(), u.z(), 0.0, u.x(), u.y(), u.x(), 0.0;
  const RadialJet reference = jet_from_extension(f, first, second, u);
  EXPECT_NEAR(reference.gradient.dot(u), 0.0, 1e-15);
  EXPECT_NEAR((reference.hessian * u + reference.gradient).norm(), 0.0, 1e-15);
  EXPECT_NEAR(reference.hessian.trace(), -12.0 * f, 1e-14);  // degree 3: -3 * 4
  for (const double k : {-3.0, -1.0, 2.5}) {
    const Matrix3 outer = first * u.transpose() + u * first.transpose();
    const Vector3 gradient = first + k * f * u;
    const Matrix3 hessian =
        second + k * outer + k * f * (Matrix3::Identity() + (k - 2.0) * u * u.transpose());
    const RadialJet jet = jet_from_extension(f, gradient, hessian, u);
    EXPECT_NEAR((jet.gradient - reference.gradient).norm(), 0.0, 1e-15);
    EXPECT_NEAR((jet.hessian - reference.hessian).norm(), 0.0, 1e-14);
  }
}

TEST(RadialSurface, IntegralsOfAShiftedSphere) {
  const double radius = 1.5;
  const Vector3 center(0.2, -0.3, 0.4);
  const ShiftedSphere surface(radius, center);
  const SurfaceIntegrals integrals = integrate(surface, 60, Execution(2));
  EXPECT_NEAR(integrals.volume, 4.0 / 3.0 * pi * std::pow(radius, 3), 1e-12);
  EXPECT_NEAR(integrals.area, 4.0 * pi * radius * radius, 1e-12);
  EXPECT_NEAR((integrals.centroid - center).norm(), 0.0, 1e-13);
  EXPECT_GT(integrals.gradient_square, 0.0);
  EXPECT_ERROR(integrate(surface, 0, Execution(1)), InvalidInput);
}

TEST(RadialSurface, AreaElementsAndAreaOfAShiftedSphere) {
  const ShiftedSphere surface(1.5, Vector3(0.2, -0.3, 0.4));
  const std::vector<Vector3> u = random_directions(50, test::announced(31));
  const AreaElements read = area_elements(surface, u, Execution(2));
  const std::vector<RadialJet> jets = surface.jets(u, Derivatives::First, Execution(1));
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_EQ(read.radii[i], jets[i].radius);
    EXPECT_EQ(read.elements[i], area_element(jets[i]));
  }
  EXPECT_NEAR(surface_area(surface, 60, Execution(2)), 4.0 * pi * 1.5 * 1.5, 1e-12);
}

TEST(RadialSurface, IntegralsHaveTheSameBitsOnAnyNumberOfThreads) {
  const ShiftedSphere surface(1.5, Vector3(0.2, -0.3, 0.4));
  const SurfaceIntegrals one = integrate(surface, 50, Execution(1));
  const SurfaceIntegrals many = integrate(surface, 50, Execution(4));
  EXPECT_EQ(one.volume, many.volume);
  EXPECT_EQ(one.area, many.area);
  EXPECT_EQ(one.centroid, many.centroid);
}

TEST(RadialSurface, GradientSquareOfAShiftedSphereToSecondOrder) {
  // r = R + u . c + O(c^2): integral of |grad|^2 = 2 * 4 pi / 3 |c|^2 + O(c^4).
  const double shift = 1e-4;
  const SurfaceIntegrals integrals =
      integrate(ShiftedSphere(1.0, Vector3(0.0, shift, 0.0)), 20, Execution(1));
  EXPECT_NEAR(integrals.gradient_square / (shift * shift), 8.0 * pi / 3.0, 1e-6);
}

TEST(RadialSurface, ArraysCoverEveryDirectionOnce) {
  const ShiftedSphere surface(2.0, Vector3(0.1, 0.2, 0.3));
  const std::vector<Vector3> u = random_directions(3001, test::announced(2));
  const std::vector<double> radii = surface.radii(u, Execution(3));
  EXPECT_EQ(surface.calls.load(), 3001);
  for (std::size_t i = 0; i < u.size(); ++i) {
    ASSERT_EQ(radii[i], surface.radius(u[i]));
    ASSERT_NEAR((radii[i] * u[i] - Vector3(0.1, 0.2, 0.3)).norm(), 2.0, 1e-14);
  }
  EXPECT_TRUE(surface.radii({}, Execution(1)).empty());
}

TEST(RadialSurface, SaddleHasCurvaturesOfBothSigns) {
  // A one-sheet neck: r = sqrt(1 / (1 - 2 z^2)) near the equator is x^2 + y^2 - z^2 = 1.
  const Vector3 u = Vector3::UnitX();
  const RadialJet jet =
      jet_from_extension(1.0, Vector3::Zero(), Vector3(0.0, 0.0, 2.0).asDiagonal(), u);
  const PrincipalCurvatures k = principal_curvatures(jet, u);
  EXPECT_NEAR(k.maximum, 1.0, 1e-15);
  EXPECT_NEAR(k.minimum, -1.0, 1e-15);
}

TEST(RadialSurface, IntegratesUntilVolumeAndAreaStayOrRefuses) {
  // 4 pi / 3 a b c and, of an octahedron, 4 / 3 a b c; the last two grids may differ by 1e-4.
  const double rod = integrate(Ellipsoid({15.0, 1.0, 1.0}), Execution()).volume;
  EXPECT_NEAR(rod / (20.0 * pi), 1.0, 1e-4);
  const double octahedron =
      integrate(Superellipsoid({3.0, 2.0, 1.0}, 2.0, 2.0), Execution()).volume;
  EXPECT_NEAR(octahedron / 8.0, 1.0, 1e-4);
  EXPECT_ERROR(integrate(Ellipsoid({1000.0, 1.0, 1.0}), Execution()), InvalidInput);
  EXPECT_ERROR(integrate(Ellipsoid({1e6, 1.0, 1e-6}), Execution()), InvalidInput);
}

}  // namespace
}  // namespace wscvt
