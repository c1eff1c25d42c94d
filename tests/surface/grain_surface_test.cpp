// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/grain_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

#include "support/expect_error.h"
#include "support/random_harmonics.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

double radius(const RadialSurface& surface, const Vector3& direction) {
  RadialJet jet;
  surface.evaluate(&direction, 1, Derivatives::None, &jet);
  return jet.radius;
}

TEST(GrainSurface, IsTheSurfaceThatItsKindNames) {
  GrainSurface surface;
  surface.semi_axes = Vector3(1.0, 2.0, 3.0);
  surface.polar_exponent = 0.4;
  surface.azimuthal_exponent = 0.6;
  const Vector3 direction = Vector3(1.0, 2.0, 2.0) / 3.0;
  EXPECT_EQ(radius(*make_surface(surface), direction),
            radius(Ellipsoid(surface.semi_axes), direction));
  EXPECT_EQ(surface_name(surface), "Ellipsoid");
  surface.kind = SurfaceKind::Superellipsoid;
  EXPECT_EQ(radius(*make_surface(surface), direction),
            radius(Superellipsoid(surface.semi_axes, 0.4, 0.6), direction));
  EXPECT_EQ(surface_name(surface), "Superellipsoid");
  EXPECT_FALSE(holds_map(surface));
}

TEST(GrainSurface, ReadsHarmonicsByTheEndingOfTheirFile) {
  GrainSurface surface;
  surface.kind = SurfaceKind::Harmonics;
  surface.coefficients_file = testing::TempDir() + "wscvt_grain_surface.DAT";
  std::ofstream(surface.coefficients_file) << "0 0 10 0\n1 0 0.5 0\n1 1 0 0\n1 -1 0 0\n";
  EXPECT_FALSE(holds_map(surface));
  EXPECT_EQ(surface_name(surface), "wscvt_grain_surface");
  const Vector3 up = Vector3::UnitZ();
  const double all = radius(*make_surface(surface), up);
  surface.coefficient_degree = 0;
  const double cut = radius(*make_surface(surface), up);
  EXPECT_NEAR(cut, 10.0 / std::sqrt(4.0 * std::acos(-1.0)), 1e-12);
  EXPECT_GT(all, cut);
  std::remove(surface.coefficients_file.c_str());
  EXPECT_ERROR(make_surface(surface), InputOutput);
}

TEST(GrainSurface, KnowsAFileOfAMap) {
  GrainSurface surface;
  surface.coefficients_file = testing::TempDir() + "wscvt_grain_surface_map.json";
  write_harmonic_map(surface.coefficients_file, test::affine_map(Vector3(1.0, 0.7, 0.5)));
  EXPECT_FALSE(holds_map(surface)) << "an ellipsoid, whatever file is named";
  surface.kind = SurfaceKind::Harmonics;
  EXPECT_TRUE(holds_map(surface));
  write_harmonics(surface.coefficients_file, HarmonicSurface({1.0}));
  EXPECT_FALSE(holds_map(surface));
  std::remove(surface.coefficients_file.c_str());
}

TEST(GrainSurface, RefusesWhatIsOutOfRange) {
  const auto refused = [](const auto& change) {
    GrainSurface surface;
    change(surface);
    EXPECT_ERROR(check_grain_surface(surface), InvalidInput);
  };
  EXPECT_NO_THROW(check_grain_surface(GrainSurface()));
  refused([](GrainSurface& one) { one.semi_axes.y() = 0.0; });
  refused([](GrainSurface& one) { one.semi_axes.z() = std::numeric_limits<double>::quiet_NaN(); });
  refused([](GrainSurface& one) { one.polar_exponent = 2.1; });
  refused([](GrainSurface& one) { one.azimuthal_exponent = 0.0; });
  refused([](GrainSurface& one) { one.coefficient_degree = -2; });
  refused([](GrainSurface& one) { one.kind = static_cast<SurfaceKind>(3); });
  refused([](GrainSurface& one) { one.kind = SurfaceKind::Harmonics; });
  refused([](GrainSurface& one) {
    one.kind = SurfaceKind::Harmonics;
    one.coefficients_file = "grain.ply";
  });
}

}  // namespace
}  // namespace wscvt
