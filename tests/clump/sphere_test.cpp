// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

TEST(SphereMesh, OfTwoSpheresHasTheirVolume) {
  const double r = 1.3;
  const double s = 0.9;
  const double d = 1.5;
  const Vector3 first(4.0, -2.0, 7.0);
  const Vector3 second = first + d * Vector3(2.0, -1.0, 0.5).normalized();
  const IndexedMesh mesh = sphere_union_mesh({{first, r}, {second, s}}, Execution(1));
  EXPECT_EQ(test::bad_edges(mesh), 0U);
  // The lens that both share.
  const double lens =
      pi * std::pow(r + s - d, 2) * (d * d + 2 * d * (r + s) - 3 * std::pow(r - s, 2)) / (12 * d);
  const double volume = 4.0 / 3.0 * pi * (r * r * r + s * s * s) - lens;
  EXPECT_NEAR(describe_shape(mesh, Execution(1)).volume / volume, 1.0, 3e-3);
  const Vector3 centroid = describe_shape(mesh, Execution(1)).centroid;
  EXPECT_NEAR((centroid - first).cross(second - first).norm(), 0.0, 1e-2);
  for (const Vector3& p : mesh.points) {
    const double distance = std::min((p - first).norm() - r, (p - second).norm() - s);
    EXPECT_NEAR(distance, 0.0, 1e-4);
  }
}

TEST(SphereMesh, OfASmallSphereBesideALargeOneHasBoth) {
  const IndexedMesh mesh =
      sphere_union_mesh({{{0, 0, 0}, 1.0}, {{1.02, 0.1, 0.05}, 0.06}}, Execution(1));
  EXPECT_EQ(test::bad_edges(mesh), 0U);
  double reach = 0.0;
  for (const Vector3& p : mesh.points) reach = std::max(reach, p.x());
  EXPECT_NEAR(reach, 1.08, 5e-3);
}

TEST(SphereMesh, RefusesNoSphereAndNoRadius) {
  EXPECT_ERROR(sphere_union_mesh({}, Execution(1)), InvalidInput);
  EXPECT_ERROR(sphere_union_mesh({{{0, 0, 0}, 0.0}}, Execution(1)), InvalidInput);
  EXPECT_ERROR(
      sphere_union_mesh({{{0, 0, 0}, std::numeric_limits<double>::infinity()}}, Execution(1)),
      InvalidInput);
}

}  // namespace
}  // namespace wscvt
