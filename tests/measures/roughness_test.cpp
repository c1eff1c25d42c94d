// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/distance_bodies.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
namespace {

double equivalent_radius(const IndexedMesh& mesh) {
  return std::cbrt(3.0 / (4.0 * test::pi) * describe_shape(mesh, Execution(1)).volume);
}

/// Of a body of about this many edges per cut-off length, at the default cut-off.
Roughness roughness_of(const IndexedMesh& mesh) {
  return surface_roughness(mesh, DetailedOptions().roughness_cutoff * equivalent_radius(mesh),
                           Execution(1));
}

TEST(Roughness, OfSmoothBodiesIsBelowThreePerMille) {
  struct Case {
    const char* name;
    test::DistanceFunction body;
    double reach;
    double spacing;
  };
  for (const Case& c : {Case{"ball", test::ellipsoid({1, 1, 1}), 1.1, 0.09},
                        Case{"1 : 2 : 6", test::ellipsoid({0.5, 1, 3}), 3.1, 0.08},
                        Case{"1 : 3 : 6", test::ellipsoid({0.5, 1.5, 3}), 3.1, 0.09},
                        Case{"capsule", test::capsule(1.5, 1), 2.6, 0.12},
                        Case{"cylinder", test::rounded_cylinder(1, 1, 0.3), 1.5, 0.08},
                        Case{"cube", test::rounded_box({1, 1, 1}, 0.3), 1.8, 0.09},
                        Case{"C", test::c_shape(0.3), 2.2, 0.08}}) {
    SCOPED_TRACE(c.name);
    const IndexedMesh mesh = test::scan_of(
        test::turned(c.body, test::random_rotation(test::announced(3))), c.reach, c.spacing);
    const Roughness r = roughness_of(mesh);
    const double radius = equivalent_radius(mesh);
    EXPECT_LT(r.sq, 0.003 * radius);
    EXPECT_GT(r.sq, 0.0);
    // What stands beside it as form is nearly all of it, and not much more. The ball has no form;
    // there Sq is that of the facets.
    EXPECT_LT(r.form_leak, 1.2 * r.sq);
    if (r.sq > 5e-4 * radius) {
      EXPECT_GT(r.form_leak, 0.8 * r.sq);
    }
  }
}

/// Rings of height `height` about a capsule, whose length along its surface is `wave` everywhere.
std::function<double(const Vector3&)> rings(double height, double wave, double half_length,
                                            double radius) {
  return [=](const Vector3& p) {
    const double beyond = std::max(std::abs(p.x()) - half_length, 0.0);
    const double along = std::min(std::abs(p.x()), half_length) +
                         radius * std::atan2(beyond, std::hypot(p.y(), p.z()));
    return height * std::cos(2.0 * test::pi * along / wave);
  };
}

TEST(Roughness, OfASineIsItsHeight) {
  const double height = 0.004;
  for (const double wave : {0.13, 0.11}) {
    SCOPED_TRACE(wave);
    const IndexedMesh mesh = test::scan_of(
        test::with_heights(test::capsule(1.0, 0.35), rings(height, wave, 1.0, 0.35)), 1.4, 0.025);
    const Roughness r = surface_roughness(mesh, 0.3, Execution(1));
    // The filter leaves 0.01 to 0.03 of them in the form.
    EXPECT_NEAR(r.sq, height / std::sqrt(2.0), 0.05 * height / std::sqrt(2.0));
    EXPECT_NEAR(r.sa, height * 2.0 / test::pi, 0.05 * height * 2.0 / test::pi);
    EXPECT_NEAR(r.ssk, 0.0, 0.1);
    EXPECT_NEAR(r.sku, 1.5, 0.1);
  }
}

TEST(Roughness, LongWavesAreForm) {
  const double height = 0.01;
  const IndexedMesh mesh = test::scan_of(
      test::with_heights(test::capsule(1.5, 0.35), rings(height, 0.9, 1.5, 0.35)), 1.95, 0.06);
  EXPECT_LT(surface_roughness(mesh, 0.3, Execution(1)).sq, 0.1 * height);
  EXPECT_GT(surface_roughness(mesh, 1.8, Execution(1)).sq, 0.5 * height);
}

TEST(Roughness, SteepWavesAreFilteredAsShallowOnes) {
  // The surface of the steep ones is a fifth longer than that below it: a filter that went along
  // the waves instead of their form would take them for longer ones, and keep fewer.
  const auto sq_of_height = [](double height) {
    const IndexedMesh mesh = test::scan_of(
        test::with_heights(test::capsule(0.5, 0.4), rings(height, 0.2, 0.5, 0.4)), 1.0, 0.022);
    return surface_roughness(mesh, 0.3, Execution(1)).sq / height;
  };
  // The filter's two passes leave 0.93 (measured), one would leave 0.80.
  EXPECT_GT(sq_of_height(0.03) / sq_of_height(0.003), 0.88);
}

TEST(Roughness, BumpsArePositiveAndPitsNegativeOnAFoldedBody) {
  // Small caps at the points of a lattice, on a body that no ray from within sees whole.
  for (const double sign : {1.0, -1.0}) {
    SCOPED_TRACE(sign);
    const auto caps = [sign](const Vector3& p) {
      const double pitch = 0.25;
      const Vector3 q(p.x() / pitch, p.y() / pitch, p.z() / pitch);
      const Vector3 from = pitch * (q - Vector3(q.array().round().matrix()));
      return sign * 0.03 * std::exp(-from.squaredNorm() / (2.0 * 0.04 * 0.04));
    };
    const IndexedMesh mesh =
        test::scan_of(test::with_heights(test::c_shape(0.3), caps), 2.2, 0.055);
    const Roughness r = surface_roughness(mesh, 0.3, Execution(1));
    EXPECT_GT(sign * r.ssk, 0.5);
    EXPECT_GT(r.sku, 3.0);
  }
}

TEST(Roughness, HeightsAreTakenFromTheirMean) {
  // Sq and Ssk of the caps would hold their mean otherwise: the filter keeps it in the form, but
  // not on a sphere, which it shrinks: a smooth ball would have a height of 1 % at this cut-off.
  const IndexedMesh mesh = test::sphere(4);
  const Roughness r = surface_roughness(mesh, 2.0, Execution(1));
  EXPECT_LT(r.sq, 1e-3);
  EXPECT_LT(r.sa, 1e-3);
}

TEST(Roughness, DoesNotDependOnScalePoseOrOrder) {
  const IndexedMesh mesh = test::lumpy(4);
  const Roughness a = surface_roughness(mesh, 0.6, Execution(1));
  const double scale = 1e-6;
  const Roughness b = surface_roughness(
      test::shuffled(
          test::transformed(mesh, scale * test::random_rotation(test::announced(2)), {3e-6, 0, 0}),
          7),
      0.6 * scale, Execution(2));
  EXPECT_NEAR(b.sq / scale / a.sq, 1.0, 1e-6);
  EXPECT_NEAR(b.sa / scale / a.sa, 1.0, 1e-6);
  EXPECT_NEAR(b.form_leak / scale / a.form_leak, 1.0, 1e-6);
  EXPECT_NEAR(b.ssk, a.ssk, 1e-5);
  EXPECT_NEAR(b.sku, a.sku, 1e-5);
  EXPECT_DOUBLE_EQ(b.cutoff, 0.6 * scale);
}

TEST(Roughness, RefusesEdgesLongerThanAThirdOfTheCutOff) {
  const IndexedMesh mesh = test::sphere(3);
  // Edges of 0.14 to 0.16.
  const double least = least_cutoff(mesh);
  EXPECT_GT(least, 3.0 * 0.14);
  EXPECT_LT(least, 3.0 * 0.165);
  EXPECT_NO_THROW(surface_roughness(mesh, 1.001 * least, Execution(1)));
  EXPECT_ERROR(surface_roughness(mesh, 0.999 * least, Execution(1)), InvalidInput);
  EXPECT_ERROR(surface_roughness(mesh, 0.0, Execution(1)), InvalidInput);
  EXPECT_ERROR(surface_roughness(mesh, std::nan(""), Execution(1)), InvalidInput);
}

TEST(Roughness, LeastCutOffWeighsEdgesByArea) {
  // Three times the mean edge of a triangle of 3, 4 and 5.
  EXPECT_NEAR(least_cutoff({{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}}), 12.0, 1e-12);
  // One face of a box in a thousand small ones: its edges are few, its area is all.
  IndexedMesh mesh = test::box(1, 1, 1);
  const double all = least_cutoff(mesh);
  EXPECT_NEAR(all, 2.0 + std::sqrt(2.0), 1e-12);
  const IndexedMesh joined =
      test::joined(mesh, test::moved(test::subdivided(test::box(1, 1, 1), 3), 0.01, {3, 0, 0}));
  EXPECT_NEAR(least_cutoff(joined), all, 1e-3);
}

}  // namespace

namespace {

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
  const HarmonicSurface ball({std::sqrt(4.0 * test::pi)});
  EXPECT_NEAR(printed_sdq(ball, 50, Execution(1)), 0.0, 1e-12);
  EXPECT_ERROR(printed_sdq(ball, 0, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
