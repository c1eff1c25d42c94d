// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/volume_offset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

MeshSums sums_of(const IndexedMesh& mesh) {
  return mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1));
}

TEST(VolumeOffset, MovesABallByOneDistanceToItsVolume) {
  for (const double grown : {1.05, 0.97}) {
    SCOPED_TRACE(grown);
    IndexedMesh ball = test::moved(test::sphere(3), 1.0, Vector3(0.3, -2.0, 0.1));
    const double wanted = std::pow(grown, 3) * sums_of(ball).volume();
    const std::vector<Vector3> before = ball.points;
    const double offset = offset_to_volume(ball.points, ball.triangles, wanted);
    EXPECT_NEAR(sums_of(ball).volume() / wanted, 1.0, 1e-13);
    EXPECT_NEAR(offset, grown - 1.0, 1e-4);
    // The last step of Newton's method is far below what it makes good.
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_NEAR((ball.points[i] - before[i]).norm(), std::abs(offset), 1e-6);
    }
  }
}

TEST(VolumeOffset, MovesAPlatesSheetsApart) {
  IndexedMesh plate = test::subdivided(test::box(2.0, 1.5, 0.1), 4);
  const double wanted = 1.2 * sums_of(plate).volume();
  const double offset = offset_to_volume(plate.points, plate.triangles, wanted);
  EXPECT_NEAR(sums_of(plate).volume() / wanted, 1.0, 1e-13);
  // A fifth of the volume, .06, over the area of 6.7.
  EXPECT_NEAR(offset, 0.06 / 6.7, 0.0005);
}

TEST(VolumeOffset, ScalesWhatIsFarFromItsVolume) {
  const Vector3 shift(3.0, -1.0, 0.4);
  for (const double factor : {2.0, 0.5}) {
    SCOPED_TRACE(factor);
    const IndexedMesh before =
        test::moved(test::scaled(test::sphere(1), Vector3(3, 2, 1)), 1, shift);
    IndexedMesh body = before;
    const double wanted = std::pow(factor, 3) * sums_of(body).volume();
    const double offset = offset_to_volume(body.points, body.triangles, wanted);
    double mean = 0.0;
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      const Vector3 expected = shift + factor * (before.points[i] - shift);
      EXPECT_LT((body.points[i] - expected).norm(), 1e-12);
      mean += (before.points[i] - shift).norm() / static_cast<double>(body.points.size());
    }
    EXPECT_NEAR(offset, (factor - 1.0) * mean, 1e-12);
  }
}

TEST(VolumeOffset, LeavesWhatHasNoVolume) {
  IndexedMesh inside_out = test::sphere(1);
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  const std::vector<Vector3> before = inside_out.points;
  EXPECT_EQ(offset_to_volume(inside_out.points, inside_out.triangles, 4.0), 0.0);
  EXPECT_EQ(inside_out.points, before);
}

}  // namespace
}  // namespace wscvt
