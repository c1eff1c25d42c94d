// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/seeds.h"

namespace wscvt {
namespace {

TEST(Orientation, HasTheSignOfTheDeterminant) {
  const Vector3 a(0, 0, 1);
  const Vector3 b(1, 0, 1);
  const Vector3 c(0, 1, 1);
  EXPECT_EQ(orientation(a, b, c, {0, 0, 2}), 1);
  EXPECT_EQ(orientation(a, b, c, {5, 7, 0}), -1);
  EXPECT_EQ(orientation(a, b, c, {-3, 4, 1}), 0);
  EXPECT_TRUE(counter_clockwise({1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
  EXPECT_FALSE(counter_clockwise({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));
  EXPECT_EQ(sphere_orientation({1, 0, 0}, {0, 1, 0}, {1, 1, 0}), 0);
}

// Points within a last place of a plane: the determinant in doubles is mostly noise.
TEST(Orientation, IsExactNextToAPlane) {
  std::mt19937_64 random(test::announced(5));
  int differ = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto number = [&] { return 0.5 + std::ldexp(static_cast<double>(random() >> 44), -20); };
    const Vector3 a(number(), number(), 0.0);
    const Vector3 b(number(), number(), 0.0);
    const Vector3 c(number(), number(), 0.0);
    // Twenty-bit coordinates: this determinant, the turn of abc in the plane, has no rounding.
    const double turn = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    const int side = turn > 0.0 ? 1 : turn < 0.0 ? -1 : 0;
    const double height = std::ldexp(1.0, -80);
    const Vector3 shear(number(), number(), number());
    // Leaning the plane rounds; the answers for above and below must still be opposite, and stay
    // the same when the corners are passed on in turn.
    const auto lean = [&](const Vector3& p) { return Vector3(p + shear * (p.x() + p.y())); };
    EXPECT_EQ(orientation(a, b, c, Vector3(0.7, 0.6, height)), side);
    EXPECT_EQ(orientation(a, b, c, Vector3(0.7, 0.6, -height)), -side);
    const Vector3 d = lean(Vector3(0.7, 0.6, 0.0));
    const int exact = orientation(lean(a), lean(b), lean(c), d);
    EXPECT_EQ(orientation(lean(b), lean(c), lean(a), d), exact);
    EXPECT_EQ(orientation(lean(b), lean(a), lean(c), d), -exact);
    EXPECT_EQ(orientation(d, lean(c), lean(b), lean(a)), exact);
    const double rounded = (lean(b) - lean(a)).cross(lean(c) - lean(a)).dot(Vector3(d - lean(a)));
    if ((rounded > 0.0 ? 1 : rounded < 0.0 ? -1 : 0) != exact) ++differ;
  }
  EXPECT_GT(differ, 100);  // else this test could not tell exact from rounded
}

}  // namespace
}  // namespace wscvt
