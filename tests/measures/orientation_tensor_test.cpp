// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/form_axes.h"

namespace wscvt {
namespace {

TEST(OrientationTensor, BoxIsExact) {
  // Face pairs of 6, 3 and 2 on a box of 1 x 2 x 3: eigenvalues 6/11, 3/11, 2/11.
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const OrientationTensor o = orientation_tensor(
        test::transformed(test::box(1, 2, 3), 5.0 * test::random_rotation(seed), {7, 8, 9}),
        Execution(1));
    EXPECT_NEAR(o.eigenvalues[0], 6.0 / 11.0, 1e-14);
    EXPECT_NEAR(o.eigenvalues[1], 3.0 / 11.0, 1e-14);
    EXPECT_NEAR(o.eigenvalues[2], 2.0 / 11.0, 1e-14);
    EXPECT_NEAR(o.compactness, 1.0 / 3.0, 1e-14);
    EXPECT_NEAR(o.flakiness, 0.5, 1e-14);
    EXPECT_NEAR(o.rodness, 1.0 / 6.0, 1e-14);
    EXPECT_NEAR(o.tensor.trace(), 1.0, 1e-14);
  }
}

TEST(OrientationTensor, TensorTurnsWithTheBodyAndIgnoresItsSizeAndPlace) {
  const IndexedMesh mesh = test::lumpy(3);
  const Eigen::Matrix3d plain = orientation_tensor(mesh, Execution(1)).tensor;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    const Eigen::Matrix3d turned =
        orientation_tensor(test::transformed(mesh, 5.0 * rotation, {7, 8, 9}), Execution(1)).tensor;
    // The shift rounds coordinates to 1e-15, and edges are a tenth long.
    EXPECT_LT((turned - rotation * plain * rotation.transpose()).norm(), 1e-13);
  }
}

TEST(OrientationTensor, CubeAndSphereHaveNoPreferredOrientation) {
  for (const IndexedMesh& mesh : {test::box(1, 1, 1), test::sphere(3)}) {
    const OrientationTensor o = orientation_tensor(mesh, Execution(1));
    EXPECT_NEAR(o.compactness, 1.0, 1e-12);
    EXPECT_NEAR(o.flakiness, 0.0, 1e-12);
    EXPECT_NEAR(o.rodness, 0.0, 1e-12);
  }
}

TEST(OrientationTensor, OblateSpheroidAgreesWithItsIntegral) {
  // x = (sin t cos p, sin t sin p, c cos t), dA = sin t sqrt(c^2 sin^2 t + cos^2 t) dt dp,
  // n_z^2 = cos^2 t / (c^2 sin^2 t + cos^2 t).
  const double c = 0.5;
  double area = 0.0;
  double upright = 0.0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) * test::pi / n;
    const double stretch = c * c * std::sin(t) * std::sin(t) + std::cos(t) * std::cos(t);
    area += std::sin(t) * std::sqrt(stretch);
    upright += std::sin(t) * std::cos(t) * std::cos(t) / std::sqrt(stretch);
  }
  const OrientationTensor o =
      orientation_tensor(test::scaled(test::sphere(6), {1, 1, c}), Execution(1));
  // Chords of 0.02: second order.
  EXPECT_NEAR(o.eigenvalues[0], upright / area, 2e-4);
  EXPECT_NEAR(o.rodness, 0.0, 1e-3);
}

TEST(OrientationTensor, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(5);
  const OrientationTensor one = orientation_tensor(mesh, Execution(1));
  const OrientationTensor three = orientation_tensor(mesh, Execution(3));
  EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
}

TEST(OrientationTensor, RefusesAMeshWithoutArea) {
  EXPECT_ERROR(orientation_tensor(IndexedMesh(), Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
