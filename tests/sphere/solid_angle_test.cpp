// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/solid_angle.h"

#include <gtest/gtest.h>

#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(SolidAngle, OfAnOctantIsHalfPi) {
  const Vector3 x = Vector3::UnitX();
  const Vector3 y = Vector3::UnitY();
  const Vector3 z = Vector3::UnitZ();
  EXPECT_NEAR(solid_angle(x, y, z), 0.5 * test::pi, 1e-15);
  EXPECT_NEAR(solid_angle(y, x, z), -0.5 * test::pi, 1e-15);
}

TEST(SolidAngle, AddsUpToTheSphereAtEveryFineness) {
  // Both branches, and their joint: face angles from 0.6 down to 6e-4.
  for (int times = 0; times <= 5; ++times) {
    const IndexedMesh mesh = test::sphere(times);
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
      sum += solid_angle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    }
    EXPECT_NEAR(sum, 4.0 * test::pi, 1e-12) << mesh.triangles.size() << " faces";
  }
}

TEST(SolidAngle, OfATinyTriangleIsItsArea) {
  for (const double size : {1e-2, 1e-4, 1e-6}) {
    const Vector3 a = Vector3(0, 0, 1);
    const Vector3 b = Vector3(size, 0, 1).normalized();
    const Vector3 c = Vector3(0, size, 1).normalized();
    // The next term of the flat limit is of the order size^2.
    EXPECT_NEAR(solid_angle(a, b, c) / (0.5 * size * size), 1.0, size * size + 1e-9);
  }
}

TEST(SolidAngle, MeetsTheArctangentWhereTheSeriesTakesOver) {
  // Two triangles just on either side of numerator / denominator = 0.02.
  const auto angle = [](double size) {
    return solid_angle(Vector3(1, 0, 0), Vector3(1, size, 0).normalized(),
                       Vector3(1, 0, size).normalized());
  };
  double low = 0.2;
  double high = 0.4;
  while (high - low > 2e-6) {
    const double middle = 0.5 * (low + high);
    (std::tan(0.5 * angle(middle)) < 0.02 ? low : high) = middle;
  }
  const double step = high - low;
  // The angle is smooth (its second derivative in the size is 1): so are its differences, to
  // step^2 and to rounding.
  EXPECT_NEAR(angle(high) - angle(low), angle(low) - angle(low - step), 4.0 * step * step + 1e-15);
}

}  // namespace
}  // namespace wscvt
