// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "support/random_harmonics.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/distances.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {
namespace {

MeshSurface rays_at(const IndexedMesh& mesh) {
  const double overhang = overhang_solid_angle(mesh, Vector3::Zero(), Execution(1));
  return {mesh, Vector3::Zero(), 1.0, overhang, Execution(1)};
}

HarmonicSurface grain(int degree, std::uint64_t seed) {
  return HarmonicSurface(test::random_harmonics(degree, seed));
}

double rms_difference(const HarmonicSurface& a, const HarmonicSurface& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.coefficients().size(); ++k) {
    sum += std::pow(a.coefficients()[k] - b.coefficients()[k], 2);
  }
  return std::sqrt(sum / (4.0 * test::pi));
}

IndexedMesh meshed(const RadialSurface& surface, int frequency) {
  return mesh_of_surface(surface, frequency, Execution(1));
}

TEST(HarmonicFit, RecoversABandLimitedSurface) {
  const HarmonicSurface surface = grain(12, 3);
  const HarmonicFit fit = fit_harmonics(surface, 12, Execution(1));
  // The quadrature is exact for these: rounding only.
  EXPECT_LT(rms_difference(fit.surface, surface), 1e-14);
  EXPECT_LT(fit.report.residual, 1e-13);
  EXPECT_EQ(fit.report.degree, 12);
  EXPECT_EQ(fit.report.limit, DegreeLimit::None);
}

TEST(HarmonicFit, LowerDegreesAreTheBeginningOfHigherOnes) {
  // Least squares in an orthonormal basis: leaving harmonics out changes none of the others.
  const HarmonicSurface surface = grain(12, 5);
  const HarmonicFit fit = fit_harmonics(surface, 7, Execution(1));
  for (std::size_t k = 0; k < harmonic_count(7); ++k) {
    EXPECT_NEAR(fit.surface.coefficients()[k], surface.coefficients()[k], 1e-14) << k;
  }
}

TEST(HarmonicFit, ReadsTheSurfaceAndNotItsVertices) {
  // The faces of a box, cut in four three times: 8 and 386 vertices, one surface.
  const IndexedMesh box = test::box(1.0, 1.3, 0.8);
  const HarmonicFit coarse = fit_harmonics(rays_at(box), 20, Execution(1));
  const HarmonicFit fine = fit_harmonics(rays_at(test::subdivided(box, 3)), 20, Execution(1));
  EXPECT_LT(rms_difference(coarse.surface, fine.surface), 1e-12);
  EXPECT_EQ(coarse.report.degree, 20);
  const double volume = integrate(coarse.surface, 100, Execution(1)).volume;
  // What a series of degree 20 leaves out at the edges is of second order in the residual.
  EXPECT_NEAR(volume / (1.0 * 1.3 * 0.8), 1.0, 0.01);
}

TEST(HarmonicFit, NeedlesAreReadToTheirTips) {
  // 20 : 1; the first grid sees the tips with a few rays only.
  const Ellipsoid needle(Vector3(20.0, 1.0, 1.0));
  const HarmonicFit fit = fit_harmonics(needle, 60, Execution(2));
  const double volume = integrate(fit.surface, 400, Execution(2)).volume;
  EXPECT_NEAR(volume / (4.0 / 3.0 * test::pi * 20.0), 1.0, 0.03);
  EXPECT_GT(fit.report.smallest_radius, 0.0);
}

TEST(HarmonicFit, ReadsMoreRaysUntilTheVolumeStays) {
  // The volume that a grid of so many rows, and twice as many azimuths, sees of an ellipsoid along
  // z.
  const auto volume = [](double length, int rows) {
    const GaussLegendre latitudes = gauss_legendre(rows);
    double sum = 0.0;
    for (std::size_t i = 0; i < latitudes.nodes.size(); ++i) {
      const double z = latitudes.nodes[i];
      const double radius = 1.0 / std::sqrt(z * z / (length * length) + 1.0 - z * z);
      sum += latitudes.weights[i] * 2.0 * test::pi * std::pow(radius, 3) / 3.0;
    }
    return sum;
  };
  std::set<int> seen;
  for (const double length : {10.0, 20.0, 30.0, 50.0}) {
    SCOPED_TRACE(length);
    int rows = 96;
    while (rows < 768 && std::abs(volume(length, rows) - volume(length, rows / 2)) >
                             1e-3 * volume(length, rows)) {
      rows *= 2;
    }
    seen.insert(rows);
    // Of degree 1, which needs no more for itself.
    const HarmonicFit fit = fit_harmonics(Ellipsoid(Vector3(1, 1, length)), 1, Execution(2));
    EXPECT_EQ(fit.report.rays,
              2U * static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows));
  }
  EXPECT_EQ(seen, (std::set<int>{96, 192, 384, 768}));
}

TEST(HarmonicFit, ResidualIsTheDistanceOfTheSurfaces) {
  // Measured by exact distances from 20,000 points spread by area to a mesh of the series.
  const auto expect_confirmed = [](const IndexedMesh& scan, int degree) {
    SCOPED_TRACE(degree);
    const HarmonicFit fit = fit_harmonics(rays_at(scan), degree, Execution(2));
    const MeshDistance to_series(meshed(fit.surface, 64));
    double sum = 0.0;
    const std::vector<Vector3> points = area_uniform_samples(scan, 20000);
    for (const double distance : to_series.distances(points, Execution(2))) {
      sum += distance * distance;
    }
    const double rms = std::sqrt(sum / static_cast<double>(points.size()));
    EXPECT_NEAR(fit.report.residual / rms, 1.0, 0.05);
  };
  expect_confirmed(test::subdivided(test::box(1.0, 1.3, 0.8), 3), 8);
  expect_confirmed(test::subdivided(test::box(1.0, 1.0, 4.0), 3), 20);  // with far tips
  expect_confirmed(meshed(grain(20, 7), 40), 9);
  // A slanted block pressed flat: the nearest place is far from that on the same ray, which alone
  // would make the residual a seventh too small; and most of its area is seen by few of the rays.
  Eigen::Matrix3d slant = test::random_rotation(test::announced(3));
  slant = Vector3(2.0, 1.0, 0.4).asDiagonal() * slant;
  expect_confirmed(test::transformed(test::box(1.0, 1.3, 0.8), slant), 12);
  expect_confirmed(meshed(Superellipsoid(Vector3(1.0, 0.7, 0.5), 0.3, 0.3), 50), 10);
}

TEST(HarmonicFit, ScalesWithTheLengthUnit) {
  const IndexedMesh box = test::box(1.0, 1.3, 0.8);
  const HarmonicFit reference = fit_harmonics(rays_at(box), 9, Execution(1));
  for (const double scale : {1e-6, 1e6}) {
    SCOPED_TRACE(scale);
    const HarmonicFit fit =
        fit_harmonics(rays_at(test::scaled(box, Vector3::Constant(scale))), 9, Execution(1));
    EXPECT_NEAR(fit.report.residual / scale, reference.report.residual, 1e-12);
    EXPECT_NEAR(fit.surface.coefficients()[30] / scale, reference.surface.coefficients()[30],
                1e-12);
  }
}

TEST(HarmonicFit, EnergyPerDegreeIsInvariantUnderRotation) {
  const IndexedMesh scan = meshed(grain(10, 11), 30);
  const HarmonicFit first = fit_harmonics(rays_at(scan), 8, Execution(1));
  const HarmonicFit second = fit_harmonics(
      rays_at(test::transformed(scan, test::random_rotation(test::announced(4)), Vector3::Zero())),
      8, Execution(1));
  const auto energy = [](const HarmonicFit& fit, int l) {
    double sum = 0.0;
    for (int m = -l; m <= l; ++m) {
      sum += std::pow(fit.surface.coefficients()[harmonic_index(l, m)], 2);
    }
    return std::sqrt(sum);
  };
  // The edges of the facets fall between the rays in another way: 1.2e-5 measured.
  for (int l = 0; l <= 8; ++l) EXPECT_NEAR(energy(first, l), energy(second, l), 3e-5) << l;
}

TEST(HarmonicFit, LowersTheDegreeWhereTheSeriesIsNotPositive) {
  // Forty times as wide as high: partial sums swing below zero beside the rim.
  const HarmonicFit fit = fit_harmonics(Ellipsoid(Vector3(40.0, 40.0, 1.0)), 20, Execution(1));
  EXPECT_LT(fit.report.degree, 20);
  EXPECT_EQ(fit.report.requested_degree, 20);
  EXPECT_EQ(fit.report.limit, DegreeLimit::Radius);
  EXPECT_GT(fit.report.smallest_radius, 0.0);
}

TEST(HarmonicFit, AHigherDegreeAskedForNeverGivesALowerOne) {
  // Whose series of many degrees are not positive.
  for (const double width : {15.0}) {
    const Ellipsoid flat(Vector3(width, width, 1.0));
    int last = 0;
    for (int degree = 1; degree <= 23; ++degree) {
      const int given = fit_harmonics(flat, degree, Execution(1)).report.degree;
      EXPECT_GE(given, last) << width << ", degree " << degree;
      last = given;
    }
  }
}

TEST(HarmonicFit, SameBytesOnAnyNumberOfThreads) {
  const MeshSurface rays = rays_at(test::lumpy(4));
  const HarmonicFit one = fit_harmonics(rays, 20, Execution(1));
  for (const int threads : {2, 5}) {
    const HarmonicFit many = fit_harmonics(rays, 20, Execution(threads));
    EXPECT_EQ(one.surface.coefficients(), many.surface.coefficients());
    EXPECT_EQ(one.report.residual, many.report.residual);
  }
}

TEST(HarmonicFit, RefusesDegreesOutOfRangeAndBrokenSurfaces) {
  const auto code_of = [](const RadialSurface& surface, int degree) {
    try {
      fit_harmonics(surface, degree, Execution(1));
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::Cancelled;
  };
  const Ellipsoid ellipsoid(Vector3(1.0, 1.0, 2.0));
  EXPECT_EQ(code_of(ellipsoid, -1), ErrorCode::InvalidInput);
  EXPECT_EQ(code_of(ellipsoid, 61), ErrorCode::InvalidInput);
  std::vector<double> negative(4, 0.0);
  negative[harmonic_index(1, 0)] = 1.0;
  EXPECT_EQ(code_of(HarmonicSurface(negative), 3), ErrorCode::InvalidInput);
}

}  // namespace
}  // namespace wscvt
