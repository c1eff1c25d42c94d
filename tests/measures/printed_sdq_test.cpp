// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/printed_sdq.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
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
