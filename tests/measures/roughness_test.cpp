// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/roughness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
namespace {

/// Radius 1 with `height` times the zonal harmonic of degree l on it.
HarmonicSurface waves(int l, double height) {
  std::vector<double> coefficients(harmonic_count(l), 0.0);
  coefficients[0] = std::sqrt(4.0 * test::pi);
  coefficients[harmonic_index(l, 0)] = height;
  return HarmonicSurface(coefficients);
}

/// Mean over the sphere of |Y_l0|^power, or of Y_l0^power where `sign` is kept, by the midpoint
/// rule.
double zonal_mean(int l, int power, bool sign) {
  const int n = 200000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double z = -1.0 + (2.0 * i + 1.0) / n;
    const double y = std::sqrt((2 * l + 1) / (4.0 * test::pi)) * std::legendre(l, z);
    sum += std::pow(sign ? y : std::abs(y), power) / n;
  }
  return sum;
}

TEST(Roughness, OfOneHarmonicIsItsMoments) {
  const double height = 0.01;
  for (const int l : {11, 12}) {
    SCOPED_TRACE(l);
    // The low-degree shape is the unit sphere, so areas are solid angles.
    const Roughness r = radial_roughness(waves(l, height), 8, 64, Execution(1));
    const double sq = 1.0 / std::sqrt(4.0 * test::pi);
    EXPECT_EQ(r.degree, 8);
    // The heights' kinks (Sa) end between nodes; the rest is integrated exactly, and the midpoint
    // rule errs by 1e-6.
    EXPECT_NEAR(r.sa / height, zonal_mean(l, 1, false), 2e-3);
    EXPECT_NEAR(r.sq / height, sq, 1e-9);
    EXPECT_NEAR(r.ssk, zonal_mean(l, 3, true) / std::pow(sq, 3), 1e-5);
    EXPECT_NEAR(r.sku, zonal_mean(l, 4, true) / std::pow(sq, 4), 1e-5);
  }
}

TEST(Roughness, DoesNotSeeTheLowDegreeShape) {
  const Roughness r = radial_roughness(waves(8, 0.05), 8, 64, Execution(1));
  EXPECT_LT(r.sq, 1e-6);  // the fit solves its equations to that
  EXPECT_GT(radial_roughness(waves(8, 0.05), 7, 64, Execution(1)).sq, 1e-2);
}

TEST(Roughness, OfASphereIsNothing) {
  const Roughness r = radial_roughness(waves(1, 0.0), 8, 32, Execution(1));
  EXPECT_LT(r.sq, 1e-12);
  EXPECT_EQ(r.ssk, 0.0);
  EXPECT_EQ(r.sku, 0.0);
}

TEST(Roughness, SameBitsOnAnyNumberOfThreads) {
  const Roughness one = radial_roughness(waves(12, 0.01), 8, 64, Execution(1));
  const Roughness three = radial_roughness(waves(12, 0.01), 8, 64, Execution(3));
  EXPECT_EQ(one.sa, three.sa);
  EXPECT_EQ(one.sku, three.sku);
}

TEST(Roughness, RefusesDegreesOutOfRange) {
  const HarmonicSurface surface = waves(1, 0.0);
  EXPECT_ERROR(radial_roughness(surface, -1, 32, Execution(1)), InvalidInput);
  EXPECT_ERROR(radial_roughness(surface, 32, 32, Execution(1)), InvalidInput);
  EXPECT_ERROR(radial_roughness(surface, 61, 128, Execution(1)), InvalidInput);
}

TEST(PrintedSdq, ChangesWithTheOrientationAsItsClosedFormSays) {
  // r = 1 + a z^2: the integral is pi^2 a^2. The same body lying along x, r = 1 + a x^2: 3/4 of it.
  const double a = 0.2;
  const double zonal = 1.0 / std::sqrt(5.0 / (4.0 * test::pi));       // P_2 / Y_20
  const double sectoral = 1.0 / std::sqrt(15.0 / (16.0 * test::pi));  // (x^2 - y^2) / Y_22
  std::vector<double> upright(harmonic_count(2), 0.0);
  upright[0] = (1.0 + a / 3.0) * std::sqrt(4.0 * test::pi);
  upright[harmonic_index(2, 0)] = 2.0 * a / 3.0 * zonal;
  std::vector<double> lying = upright;
  lying[harmonic_index(2, 0)] = -a / 3.0 * zonal;
  lying[harmonic_index(2, 2)] = a / 2.0 * sectoral;
  const HarmonicSurface standing_body(upright);
  const HarmonicSurface lying_body(lying);
  const double area = integrate(standing_body, 64, Execution(1)).area;
  // The midpoint rule for the area errs by about (pi / 200)^2 / 24.
  EXPECT_NEAR(printed_sdq(standing_body, 200, Execution(1)) / (test::pi * a / std::sqrt(area)), 1.0,
              1e-4);
  EXPECT_NEAR(printed_sdq(lying_body, 200, Execution(1)) /
                  (std::sqrt(0.75) * test::pi * a / std::sqrt(area)),
              1.0, 1e-4);
}

TEST(PrintedSdq, OfASphereIsZero) {
  EXPECT_NEAR(printed_sdq(waves(1, 0.0), 50, Execution(1)), 0.0, 1e-12);
  EXPECT_ERROR(printed_sdq(waves(1, 0.0), 0, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
