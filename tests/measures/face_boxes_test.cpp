// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/face_boxes.h"

#include <gtest/gtest.h>

#include <random>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/measures/distances.h"

namespace wscvt {
namespace {

double distance(const FaceBoxes& boxes, const Vector3& point) {
  return boxes.distances({point}, Execution(1)).front();
}

TEST(FaceBoxes, AgreeWithCgalsTreeNearAndFarInWhateverOrderThePointsCome) {
  const std::uint64_t seed = 8;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  const IndexedMesh mesh = test::lumpy(3);
  const FaceBoxes boxes(mesh, Execution(1), "");
  const MeshDistance query(mesh);
  std::vector<Vector3> points;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 p(uniform(engine), uniform(engine), uniform(engine));
    points.push_back(i % 3 > 0 ? query.nearest_point(p) + 0.01 * p : p);
  }
  const std::vector<double> distances = boxes.distances(points, Execution(1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(distances[i], query.distance(points[i]), 1e-14);
  }
  EXPECT_EQ(boxes.distances(points, Execution(3)), distances);
}

TEST(FaceBoxes, FarFromTheOriginTheyAreAsGood) {
  const Vector3 shift(1e6, 1e6, 1e6);
  const FaceBoxes boxes(test::transformed(test::box(1, 1, 1), Eigen::Matrix3d::Identity(), shift),
                        Execution(1), "");
  EXPECT_NEAR(distance(boxes, shift + Vector3(0.125, 0.0, 0.0)), 0.375, 1e-15);
}

TEST(FaceBoxes, PassOverFacesWithoutArea) {
  IndexedMesh mesh = test::box(1, 1, 1);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  const FaceBoxes boxes(mesh, Execution(1), "");
  EXPECT_NEAR(distance(boxes, {0, 0, 2}), 1.5, 1e-15);
  mesh.triangles.resize(1);
  EXPECT_TRUE(FaceBoxes(mesh, Execution(1), "").empty());
  EXPECT_ERROR(rms_distance(test::box(1, 1, 1), mesh, 10, Execution(1)), InvalidInput);
}

TEST(FaceBoxes, CanBeCancelledWhileTheyAreBuilt) {
  const Execution execution(1, [](double, const std::string&) { return false; });
  EXPECT_ERROR(FaceBoxes(test::sphere(5), execution, ""), Cancelled);
}

}  // namespace
}  // namespace wscvt
