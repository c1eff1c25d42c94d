// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/grain_surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/expect_error.h"

namespace wscvt {
namespace {

TEST(GrainSurface, IsNamedByItsKindOrFile) {
  GrainSurface surface;
  EXPECT_EQ(surface_name(surface), "Ellipsoid");
  surface.kind = SurfaceKind::Superellipsoid;
  EXPECT_EQ(surface_name(surface), "Superellipsoid");
  surface.kind = SurfaceKind::Harmonics;
  surface.coefficients_file = "folder/grain.DAT";
  EXPECT_EQ(surface_name(surface), "grain");
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
