// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/error_measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_error.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(ErrorMeasure, OfAScaledBodyArePowersOfTheScaleAndNeverNegative) {
  const IndexedMesh box = test::box(1, 2, 3);
  for (const double scale : {1.1, 0.9}) {
    SCOPED_TRACE(scale);
    const ShapeDescriptors scaled =
        describe_shape(test::scaled(box, Vector3::Constant(scale)), Execution(1));
    const auto error = [&](ErrorMeasure measure) {
      return error_percent(measure, scaled, describe_shape(box, Execution(1)), std::nullopt);
    };
    EXPECT_NEAR(error(ErrorMeasure::Volume), 100.0 * std::abs(std::pow(scale, 3) - 1.0), 1e-11);
    EXPECT_NEAR(error(ErrorMeasure::Area), 100.0 * std::abs(scale * scale - 1.0), 1e-11);
    EXPECT_NEAR(error(ErrorMeasure::Sphericity), 0.0, 1e-11);
    EXPECT_NEAR(error(ErrorMeasure::Inertia), 100.0 * std::abs(std::pow(scale, 5) - 1.0), 1e-10);
  }
}

TEST(ErrorMeasure, OfAnotherShapeIsThatOfItsSphericity) {
  // A cube's sphericity is (pi / 6)^(1/3), that of a box of 1 x 2 x 3 (pi 36^2)^(1/3) / 22.
  const double cube = std::cbrt(test::pi / 6.0);
  const double box = std::cbrt(test::pi * 36.0 * 36.0) / 22.0;
  EXPECT_NEAR(
      error_percent(ErrorMeasure::Sphericity, describe_shape(test::box(1, 2, 3), Execution(1)),
                    describe_shape(test::box(1, 1, 1), Execution(1)), std::nullopt),
      100.0 * (1.0 - box / cube), 1e-11);
}

TEST(ErrorMeasure, OfDistancesIsTheirRmsInEquivalentRadii) {
  // The original is a box of the volume of a ball of radius 2.
  const double side = 2.0 * std::cbrt(4.0 * test::pi / 3.0);
  const ShapeDescriptors original = describe_shape(test::box(side, side, side), Execution(1));
  const ShapeDescriptors remesh = describe_shape(test::box(1, 1, 1), Execution(1));
  MeshDistances distances;
  distances.largest = 0.5;
  distances.root_mean_square = 0.03;
  EXPECT_NEAR(error_percent(ErrorMeasure::Distance, remesh, original, distances), 1.5, 1e-12);
  EXPECT_ERROR(error_percent(ErrorMeasure::Distance, remesh, original, std::nullopt), InvalidInput);
}

}  // namespace
}  // namespace wscvt
