// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/mesh_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/sphere/solid_angle.h"

namespace wscvt {
namespace {

std::vector<Vector3> points_about(const IndexedMesh& mesh, std::uint64_t seed) {
  std::mt19937_64 engine(test::announced(seed));
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  std::vector<Vector3> points;
  for (int i = 0; i < 1000; ++i) {
    const Vector3 p(uniform(engine), uniform(engine), uniform(engine));
    points.push_back(i % 3 > 0 ? mesh.points[engine() % mesh.points.size()] + 0.01 * p : p);
  }
  return points;
}

Vector3 nearest_point(const MeshDistance& mesh, const Vector3& point) {
  std::size_t face = 0;
  mesh.squared_distance(point, face, 0.0);
  return mesh.nearest_point_of(face, point);
}

TEST(MeshTree, SignedDistancesOfABoxAreThoseToItsWallsNegativeInside) {
  const Vector3 half(0.5, 1.0, 1.5);
  const IndexedMesh box = test::box(1.0, 2.0, 3.0);
  const std::vector<Vector3> points = points_about(box, 9);
  const std::vector<double> distances = MeshDistance(box).signed_distances(points, Execution(2));
  ASSERT_EQ(distances.size(), points.size());
  std::size_t inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 beyond = points[i].cwiseAbs() - half;
    const double outside = beyond.cwiseMax(0.0).norm();
    const double expected = outside > 0.0 ? outside : beyond.maxCoeff();
    EXPECT_NEAR(distances[i], expected, 1e-14);
    if (expected < 0.0) ++inside;
  }
  EXPECT_GT(inside, 50U);
  EXPECT_LT(inside, 900U);
}

TEST(MeshTree, AgreeWithAllFacesOneByOneNearAndFarInWhateverOrderThePointsCome) {
  const IndexedMesh mesh = test::lumpy(3);
  const MeshDistance boxes(mesh, Execution(1), "");
  const std::vector<Vector3> points = points_about(mesh, 8);
  const std::vector<double> distances = boxes.distances(points, Execution(1));
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : mesh.triangles) {
      const Vector3& a = mesh.points[t[0]];
      const Vector3& b = mesh.points[t[1]];
      const Vector3& c = mesh.points[t[2]];
      const Vector3 weights = nearest_weights(a, b, c, points[i]);
      nearest =
          std::min(nearest, (weights[0] * a + weights[1] * b + weights[2] * c - points[i]).norm());
    }
    // Rounding of coordinates of order 1.
    EXPECT_NEAR(distances[i], nearest, 1e-14);
    EXPECT_EQ(boxes.distance(points[i]), distances[i]);
    EXPECT_NEAR((nearest_point(boxes, points[i]) - points[i]).norm(), nearest, 1e-14);
    EXPECT_NEAR(boxes.distance(nearest_point(boxes, points[i])), 0.0, 1e-14);
  }
  EXPECT_EQ(boxes.distances(points, Execution(3)), distances);
}

TEST(MeshTree, SearchFromAnyFaceAndEndEarlyWhereThatIsEnough) {
  const IndexedMesh mesh = test::lumpy(3);
  const MeshDistance boxes(mesh, Execution(1), "");
  std::size_t start = 0;
  for (const Vector3& point : points_about(mesh, 10)) {
    const double distance = boxes.distance(point);
    std::size_t face = start = (start + 977) % mesh.triangles.size();
    EXPECT_EQ(std::sqrt(boxes.squared_distance(point, face, 0.0)), distance);
    EXPECT_NEAR((boxes.nearest_point_of(face, point) - point).norm(), distance, 1e-14);
    const double twice = 2.0 * distance;
    face = start;
    EXPECT_LE(boxes.squared_distance(point, face, twice * twice), twice * twice);
    EXPECT_LE((boxes.nearest_point_of(face, point) - point).norm(), twice + 1e-14);
    std::size_t near = 0;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      near += (boxes.nearest_point_of(f, point) - point).norm() <= twice ? 1U : 0U;
    }
    EXPECT_EQ(boxes.faces_within(point, (1.0 + 1e-14) * twice).size(), near);
  }
}

TEST(MeshTree, AreTheSameOnAnyNumberOfThreads) {
  // 81,920 faces: more than one part.
  const IndexedMesh mesh = test::lumpy(6);
  const MeshDistance one(mesh, Execution(1), "");
  const MeshDistance three(mesh, Execution(3), "");
  for (const Vector3& point : points_about(mesh, 9)) {
    EXPECT_EQ(nearest_point(one, point), nearest_point(three, point));
  }
}

TEST(MeshTree, AreMetAnOddNumberOfTimesFromInside) {
  const IndexedMesh mesh = test::lumpy(4);
  const MeshDistance boxes(mesh, Execution(1), "");
  for (const Vector3& point : points_about(mesh, 10)) {
    // Seen from inside, and only from there, the faces' solid angles fill the sphere.
    double angle = 0.0;
    for (const Triangle& t : mesh.triangles) {
      angle += solid_angle((mesh.points[t[0]] - point).normalized(),
                           (mesh.points[t[1]] - point).normalized(),
                           (mesh.points[t[2]] - point).normalized());
    }
    EXPECT_EQ(boxes.faces_met(point) % 2 == 1, angle > 2.0 * pi);
  }
}

TEST(MeshTree, FarFromTheOriginTheyAreAsGood) {
  const Vector3 shift(1e6, 1e6, 1e6);
  const MeshDistance boxes(
      test::transformed(test::box(1, 1, 1), Eigen::Matrix3d::Identity(), shift), Execution(1), "");
  EXPECT_NEAR(boxes.distance(shift + Vector3(0.125, 0.0, 0.0)), 0.375, 1e-15);
}

TEST(MeshTree, PassOverFacesWithoutArea) {
  IndexedMesh mesh = test::box(1, 1, 1);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  const MeshDistance boxes(mesh, Execution(1), "");
  EXPECT_NEAR(boxes.distance({0, 0, 2}), 1.5, 1e-15);
  mesh.triangles.resize(1);
  EXPECT_ERROR(MeshDistance(mesh, Execution(1), ""), InvalidInput);
  EXPECT_ERROR(rms_distance(test::box(1, 1, 1), mesh, 10, Execution(1)), InvalidInput);
}

TEST(MeshTree, CanBeCancelledWhileTheyAreBuilt) {
  const Execution execution(1, [](double, const std::string&) { return false; });
  EXPECT_ERROR(MeshDistance(test::sphere(5), execution, ""), Cancelled);
}

}  // namespace
}  // namespace wscvt
