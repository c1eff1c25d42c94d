// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/sample_grain.h"

#include <gtest/gtest.h>

#include "grains/bent_grain.h"
#include "support/expect_error.h"
#include "support/random_harmonics.h"
#include "support/random_sample.h"
#include "toolbox/sample/harmonic_grid.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

IndexedMesh mesh_of(const HarmonicSurface& surface) {
  return mesh_of_surface(surface, 30, Execution(1));
}

// The white grain of an ellipsoid is the unit sphere, whose logarithm is zero. Its mesh of 10,242
// points lies 3e-4 inside.
TEST(SampleGrain, TakesTheFormOutOfAnEllipsoid) {
  const SampleGrids grids(8);
  const Vector3 axes(4.0, 2.5, 2.0);
  const IndexedMesh mesh =
      test::transformed(test::scaled(test::sphere(5), axes), test::random_rotation(4));
  const SampleGrain grain = sample_grain(mesh, grids, Execution(1));
  const double radius = std::cbrt(axes.prod());
  EXPECT_NEAR(grain.radius, radius, 1e-3 * radius);
  EXPECT_LT((grain.deviations - axes / (radius * std::sqrt(5.0))).norm(), 1e-3);
  for (const double coefficient : grain.white) EXPECT_NEAR(coefficient, 0.0, 2e-3);
  const HarmonicSurface standing(grain.radial);
  EXPECT_NEAR(standing.radius({1, 0, 0}), axes.x() / radius, 0.02);
  EXPECT_NEAR(standing.radius({0, 1, 0}), axes.y() / radius, 0.02);
  EXPECT_NEAR(standing.radius({0, 0, 1}), axes.z() / radius, 0.02);
}

TEST(SampleGrain, IsTheSameInEveryPoseAndSize) {
  const SampleGrids grids(8);
  for (const HarmonicSurface& surface : test::random_surfaces(4, 8, 11)) {
    const IndexedMesh mesh = mesh_of(surface);
    const SampleGrain grain = sample_grain(mesh, grids, Execution(1));
    const IndexedMesh moved =
        test::moved(test::transformed(mesh, test::random_rotation(17)), 2.5, {3, -1, 8});
    const SampleGrain again = sample_grain(moved, grids, Execution(1));
    EXPECT_NEAR(again.radius, 2.5 * grain.radius, 1e-9);
    EXPECT_LT((again.deviations - grain.deviations).norm(), 1e-9);
    EXPECT_LT(largest_difference(again.radial, grain.radial), 1e-9);
    EXPECT_LT(largest_difference(again.white, grain.white), 1e-9);
  }
}

// A mesh of 9,002 points lies 5e-4 inside its surface.
TEST(SampleGrain, IsTheSameOfASeriesAndOfItsMesh) {
  const SampleGrids grids(8);
  for (const HarmonicSurface& surface : test::random_surfaces(4, 8, 12)) {
    const SampleGrain grain = sample_grain(surface, grids, Execution(1));
    const SampleGrain meshed = sample_grain(mesh_of(surface), grids, Execution(1));
    EXPECT_NEAR(meshed.radius, grain.radius, 2e-3 * grain.radius);
    EXPECT_LT(largest_difference(meshed.radial, grain.radial), 3e-3);
    EXPECT_LT(largest_difference(meshed.white, grain.white), 3e-3);
  }
}

// The third moments about the centroid choose the ends of the axes. Series off the origin, whose
// moments need all terms; a turned axis would differ by .02 and more.
TEST(SampleGrain, StandsWithTheSameEndsUpAsASeriesAndAsAMesh) {
  const SampleGrids grids(6);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    std::vector<double> coefficients = test::random_harmonics(6, seed);
    for (std::size_t k = 1; k < 4; ++k) coefficients[k] *= 8.0;
    const HarmonicSurface surface(coefficients);
    const SampleGrain grain = sample_grain(surface, grids, Execution(1));
    const SampleGrain meshed = sample_grain(mesh_of(surface), grids, Execution(1));
    EXPECT_LT(largest_difference(meshed.radial, grain.radial), 5e-3) << seed;
  }
}

// Waves all over a long grain: stretched to a white grain, those along it become shorter, so that
// it needs a higher degree: the rms difference is 6e-4 of the radius, and 12e-4 at four degrees
// more than the grain.
TEST(SampleGrain, WhiteGrainsKeepTheWavesOfALongGrain) {
  const int most = 24;
  const SampleGrids grids(most);
  std::vector<double> waves = test::random_harmonics(most, 6);
  for (std::size_t k = 0; k < waves.size(); ++k) {
    const int l = static_cast<int>(std::sqrt(static_cast<double>(k)));
    waves[k] *= l < 2 ? 0.0 : std::sqrt(1.0 + l);
  }
  const HarmonicGrid& fine = grids.fine_radial();
  std::vector<double> radii = fine.values(waves);
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const Vector3& u = fine.directions()[k];
    radii[k] =
        (1.0 + radii[k] / std::sqrt(4.0 * pi)) / u.cwiseQuotient(Vector3(1.8, 0.9, 0.7)).norm();
  }
  const HarmonicSurface surface(fine.coefficients(radii));
  const SampleGrain grain = sample_grain(surface, grids, Execution(2));
  const HarmonicSeries white(grain.white);
  const HarmonicSurface radial(grain.radial);
  double of_white = 0.0;
  for (const Vector3& u : random_directions(2000, 3)) {
    double logarithm = 0.0;
    white.sum(&u, 1, &logarithm);
    const Vector3 point = std::exp(logarithm) * std::sqrt(5.0) * u.cwiseProduct(grain.deviations);
    of_white += std::pow(point.norm() - radial.radius(point.normalized()), 2) / 2000.0;
  }
  EXPECT_LT(std::sqrt(of_white), 8e-4);
}

TEST(SampleGrain, HasUnitVolumeAndStandsInItsPrincipalFrame) {
  const SampleGrids grids(8);
  for (const HarmonicSurface& surface : test::random_surfaces(5, 8, 13)) {
    const SampleGrain grain = sample_grain(surface, grids, Execution(1));
    const HarmonicGrid& grid = grids.fine_radial();
    const RadialMoments moments = radial_moments(grid, grid.values(grain.radial));
    EXPECT_NEAR(moments.volume, 4.0 * pi / 3.0, 5e-3);
    EXPECT_LT(moments.centroid.norm(), 2e-3);
    const Eigen::Matrix3d expected = grain.deviations.cwiseAbs2().asDiagonal();
    EXPECT_LT((moments.covariance - expected).norm(), 3e-3);
    EXPECT_GT(grain.deviations[0], grain.deviations[1]);
    EXPECT_GT(grain.deviations[1], grain.deviations[2]);
  }
}

// The series of degree 12 rounds the bodies off.
TEST(SampleGrain, ReadsWhatRaysDoNotSee) {
  const SampleGrids grids(12);
  for (const char* name : {"C-shape", "crescent"}) {
    const IndexedMesh scan = test::bent_grain_mesh(test::bent_grain(name), 1500);
    const ShapeDescriptors shape = describe_shape(scan, Execution(1));
    const SampleGrain grain = sample_grain(scan, grids, Execution(1));
    ASSERT_TRUE(has_offset(grain.radial_offset)) << name;
    const IndexedMesh sphere = test::sphere(4);
    const IndexedMesh mesh{surface_points(grain.radial, grain.radial_offset, sphere.points),
                           sphere.triangles};
    EXPECT_TRUE(self_intersections(mesh).empty()) << name;
    const ShapeDescriptors read = describe_shape(mesh, Execution(1));
    EXPECT_NEAR(read.volume / (4.0 * pi / 3.0), 1.0, 0.12) << name;
    EXPECT_NEAR(read.sphericity, shape.sphericity, 0.05) << name;
    EXPECT_LT(read.centroid.norm(), 0.2) << name;
    const double fold = overhang_solid_angle(scan, shape.centroid, Execution(1));
    EXPECT_NEAR(overhang_solid_angle(mesh, read.centroid, Execution(1)), fold, 0.15 * fold) << name;
    // The white grain has the inertia of the unit sphere.
    std::vector<Vector3> white = offset_values(grain.white_offset, sphere.points);
    std::vector<double> logarithms(white.size());
    HarmonicSeries(grain.white).sum(sphere.points.data(), white.size(), logarithms.data());
    for (std::size_t k = 0; k < white.size(); ++k) {
      white[k] += std::exp(logarithms[k]) * sphere.points[k];
    }
    const ShapeDescriptors round = describe_shape({white, sphere.triangles}, Execution(1));
    EXPECT_LT((round.inertia_semi_axes - Vector3::Ones()).cwiseAbs().maxCoeff(), 0.12) << name;
  }
}

// A C with a thin handle on its back.
TEST(SampleGrain, CutsSmallHandlesOfWhatRaysDoNotSee) {
  const IndexedMesh mug = test::body_of_depth([](const Vector3& p) {
    const double angle = std::clamp(std::atan2(p.y(), p.x()), -2.4, 2.4);
    const Vector3 spine(0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.0);
    const double along = std::hypot(p.x() - 1.0, p.z() - 0.25) - 0.2;
    return std::max(0.35 - (p - spine).norm(), 0.07 - std::hypot(along, p.y()));
  });
  ASSERT_LT(mug.points.size(), mug.triangles.size() / 2 + 2);
  const SampleGrain grain = sample_grain(mug, SampleGrids(10), Execution(1));
  EXPECT_TRUE(has_offset(grain.radial_offset));
}

TEST(SampleGrain, RefusesWhatRaysDoNotSee) {
  const SampleGrids grids(4);
  EXPECT_ERROR(sample_grain(test::torus(3.0, 1.0, 24), grids, Execution(1)), InvalidInput);
  EXPECT_ERROR(sample_grain(HarmonicSurface({1.0, 9.0, 0.0, 0.0}), grids, Execution(1)),
               InvalidInput);
  EXPECT_ERROR(SampleGrids(3), InvalidInput);
  EXPECT_ERROR(SampleGrids(57), InvalidInput);
}

TEST(SampleGrain, FindsRadiiInAnotherFrame) {
  const Ellipsoid ellipsoid({3.0, 2.0, 1.5});
  const LogRadii surface = [&](const std::vector<Vector3>& directions,
                               std::vector<double>& values) {
    ellipsoid.evaluate_radii(directions.data(), directions.size(), values.data());
    for (double& value : values) value = std::log(value);
    return true;
  };
  const Vector3 centre(0.4, -0.3, 0.2);
  const Eigen::Matrix3d axes =
      test::random_rotation(5) * Vector3(0.5, 1.5, 2.0).asDiagonal().toDenseMatrix();
  const std::vector<Vector3> directions = random_directions(50, 6);
  const auto radii = radii_in_frame(surface, centre, axes, directions);
  ASSERT_TRUE(radii.has_value());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Vector3 point = centre + (*radii)[k] * (axes * directions[k]);
    EXPECT_NEAR(point.cwiseQuotient(Vector3(3.0, 2.0, 1.5)).norm(), 1.0, 1e-7);
  }
  EXPECT_FALSE(radii_in_frame(surface, {5, 0, 0}, axes, directions).has_value());
}

}  // namespace

namespace {

TEST(HarmonicGrid, FindsTheCoefficientsOfItsValues) {
  const HarmonicGrid grid(9, 12);
  const std::vector<double> series = test::random_harmonics(9, 3);
  const std::vector<double> values = grid.values(series);
  const HarmonicSurface surface(series);
  double sum = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_NEAR(values[k], surface.radius(grid.directions()[k]), 1e-12);
    sum += grid.weights()[k];
  }
  EXPECT_NEAR(sum, 4.0 * pi, 1e-12);
  const std::vector<double> found = grid.coefficients(values);
  for (std::size_t k = 0; k < series.size(); ++k) EXPECT_NEAR(found[k], series[k], 1e-12);
}

TEST(HarmonicGrid, MirrorsASeriesAsItsDirections) {
  const std::vector<double> series = test::random_harmonics(7, 5);
  const HarmonicSurface surface(series);
  for (int bits = 0; bits < 8; ++bits) {
    const Vector3 signs((bits & 1) != 0 ? -1 : 1, (bits & 2) != 0 ? -1 : 1,
                        (bits & 4) != 0 ? -1 : 1);
    const HarmonicSurface image(mirrored(series, signs));
    for (const Vector3& u : random_directions(20, 9)) {
      EXPECT_NEAR(image.radius(u), surface.radius(signs.cwiseProduct(u)), 1e-13);
    }
  }
}

// An ellipsoid off the origin, whose moments are known.
TEST(HarmonicGrid, TakesTheMomentsOfASolid) {
  const HarmonicGrid grid(4, 60);
  const Vector3 axes(1.3, 1.1, 0.8), centre(0.1, -0.2, 0.05);
  std::vector<double> radii;
  for (const Vector3& u : grid.directions()) {
    const Vector3 a = u.cwiseQuotient(axes), c = centre.cwiseQuotient(axes);
    const double half = a.dot(c);
    radii.push_back((half + std::sqrt(half * half - a.dot(a) * (c.dot(c) - 1.0))) / a.dot(a));
  }
  const RadialMoments moments = radial_moments(grid, radii);
  EXPECT_NEAR(moments.volume, 4.0 * pi / 3.0 * axes.prod(), 1e-9);
  EXPECT_LT((moments.centroid - centre).norm(), 1e-9);
  const Eigen::Matrix3d expected = (axes.cwiseAbs2() / 5.0).asDiagonal();
  EXPECT_LT((moments.covariance - expected).norm(), 1e-9);
}

TEST(HarmonicGrid, AmplitudesAreTheRootsOfTheSquaresOfADegree) {
  const std::vector<double> amplitudes = degree_amplitudes({-2, 1, 2, 2, 3, 0, 0, 4, 0});
  EXPECT_EQ(amplitudes, (std::vector<double>{2, 3, 5}));
}

}  // namespace
}  // namespace wscvt
