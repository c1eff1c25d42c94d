// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/triangle_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "support/seeds.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(TriangleGeometry, OfARightTriangle) {
  const Vector3 a(2, 0, 0);
  const Vector3 b(0, 3, 0);
  const Vector3 c(0, 0, 4);
  EXPECT_EQ(six_volumes(a, b, c), 24.0);
  EXPECT_EQ(six_volumes(a, c, b), -24.0);
  EXPECT_EQ(doubled_area_normal(a, b, c), Vector3(12, 8, 6));
  EXPECT_EQ(triangle_area({5, 5, 5}, {8, 5, 5}, {5, 9, 5}), 6.0);
}

TEST(TriangleGeometry, SumsOfABoxAreItsVolumeAreaAndMiddleAboutAnyOrigin) {
  IndexedMesh box = test::subdivided(test::box(1, 2, 3), 3);
  Vector3 middle = Vector3::Zero();  // of a body that is symmetric about it
  for (const Vector3& p : test::box(1, 2, 3).points) middle += p / 8.0;
  for (const Vector3& origin : {Vector3(0, 0, 0), Vector3(0.3, -0.2, 5), Vector3(-40, 30, 7)}) {
    const MeshSums sums = mesh_sums(box.points, box.triangles, origin, Execution(2));
    // Terms are up to 3 x 40^2, of which 1e-16 is lost in each of 768.
    EXPECT_NEAR(sums.volume(), 6.0, 1e-10);
    EXPECT_NEAR(sums.area(), 22.0, 1e-12);
    EXPECT_LT((origin + sums.centroid() - middle).norm(), 1e-9);
    EXPECT_EQ(sums.flat_triangles, 0U);
  }
}

TEST(TriangleGeometry, SumsCountTrianglesWithoutArea) {
  IndexedMesh box = test::box(1, 1, 1);
  box.triangles.push_back({0, 1, 1});
  EXPECT_EQ(mesh_sums(box.points, box.triangles, Vector3::Zero(), Execution(1)).flat_triangles, 1U);
}

TEST(TriangleGeometry, SumsAreTheSameBytesOnAnyNumberOfThreads) {
  const IndexedMesh sphere = test::sphere(6);
  ASSERT_GT(sphere.triangles.size(), 65536U);  // several blocks
  const MeshSums one = mesh_sums(sphere.points, sphere.triangles, {0.1, 0.2, 0.3}, Execution(1));
  const MeshSums four = mesh_sums(sphere.points, sphere.triangles, {0.1, 0.2, 0.3}, Execution(4));
  EXPECT_EQ(one.six_volumes, four.six_volumes);
  EXPECT_EQ(one.doubled_area, four.doubled_area);
  EXPECT_EQ(one.moment, four.moment);
}

TEST(TriangleGeometry, VertexAreasShareOutTheArea) {
  const IndexedMesh box = test::box(1, 2, 3);
  const std::vector<double> areas = vertex_areas(box);
  ASSERT_EQ(areas.size(), box.points.size());
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 22.0, 1e-12);
  const IndexedMesh one{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {9, 9, 9}}, {{0, 1, 2}}};
  EXPECT_EQ(vertex_areas(one), (std::vector<double>{2, 2, 2, 0}));
}

TEST(TriangleGeometry, VertexNormalsAreTheMeanOfTheTrianglesByArea) {
  // At the tip of a corner of 2 x 3 x 4 the right-angled faces weigh as their areas do.
  const IndexedMesh corner{
      {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}, {9, 9, 9}},
      {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 1, 4}},
  };
  const std::vector<Vector3> normals = vertex_normals(corner.points, corner.triangles);
  EXPECT_LT((normals[0] - Vector3(-12, -8, -6).normalized()).norm(), 1e-15);
  EXPECT_LT((normals[1] - Vector3(0, -8, -6).normalized()).norm(), 1e-15);
  EXPECT_EQ(normals[4], Vector3::Zero());  // of a triangle without area alone
}

TEST(TriangleGeometry, LargestCornerCosineIsThatOfTheSmallestAngle) {
  std::mt19937_64 engine(test::announced(2));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Vector3(uniform(engine), uniform(engine), uniform(engine)); };
  for (int i = 0; i < 200; ++i) {
    const std::array<Vector3, 3> corners{point(), point(), point()};
    std::array<double, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k) {
      sides[k] = (corners[(k + 1) % 3] - corners[(k + 2) % 3]).norm();
    }
    std::sort(sides.begin(), sides.end());
    // The smallest angle lies opposite to the shortest side; law of cosines.
    const double expected = (sides[1] * sides[1] + sides[2] * sides[2] - sides[0] * sides[0]) /
                            (2.0 * sides[1] * sides[2]);
    EXPECT_NEAR(largest_corner_cosine(corners[0], corners[1], corners[2]), expected, 1e-12);
  }
  EXPECT_EQ(largest_corner_cosine({1, 2, 3}, {1, 2, 3}, {4, 5, 6}), 1.0);
}

TEST(TriangleGeometry, NearestWeightsAreThoseOfTheNearestPoint) {
  // Against the foot of the perpendicular where it lies inside, and the nearest of three segments
  // elsewhere.
  std::mt19937_64 engine(test::announced(3));
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] { return Vector3(uniform(engine), uniform(engine), uniform(engine)); };
  std::array<int, 4> met{};  // with 0, 1, 2 and 3 corners that count
  for (int i = 0; i < 4000; ++i) {
    const std::array<Vector3, 3> corners{point(), point(), point()};
    const Vector3 p = 2.0 * point();
    double expected = 100.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& from = corners[k];
      const Vector3 edge = corners[(k + 1) % 3] - from;
      const double share = std::clamp(edge.dot(p - from) / edge.squaredNorm(), 0.0, 1.0);
      expected = std::min(expected, (p - from - share * edge).norm());
    }
    const Vector3 normal = doubled_area_normal(corners[0], corners[1], corners[2]).normalized();
    const double height = normal.dot(p - corners[0]);
    const Vector3 foot = p - height * normal;
    const bool inside = doubled_area_normal(corners[0], corners[1], foot).dot(normal) > 0.0 &&
                        doubled_area_normal(corners[1], corners[2], foot).dot(normal) > 0.0 &&
                        doubled_area_normal(corners[2], corners[0], foot).dot(normal) > 0.0;
    if (inside) expected = std::abs(height);
    const Vector3 weights = nearest_weights(corners[0], corners[1], corners[2], p);
    ASSERT_GE(weights.minCoeff(), 0.0);
    ASSERT_NEAR(weights.sum(), 1.0, 1e-14);
    const Vector3 nearest =
        weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    // A needle's weights lose digits by its area over the square of its sides, 1e-4 here.
    ASSERT_NEAR((p - nearest).norm(), expected, 1e-11);
    ++met[(weights.array() > 0.0).count()];
  }
  EXPECT_EQ(met[0], 0);
  for (const int corners : {1, 2, 3}) EXPECT_GT(met[corners], 100) << corners;
}

TEST(TriangleGeometry, NearestWeightsOfItsOwnPointsAreExact) {
  const Vector3 a(1, 0, 0);
  const Vector3 b(0, 2, 0);
  const Vector3 c(0, 0, 4);
  EXPECT_EQ(nearest_weights(a, b, c, a), Vector3(1, 0, 0));
  EXPECT_EQ(nearest_weights(a, b, c, b), Vector3(0, 1, 0));
  EXPECT_EQ(nearest_weights(a, b, c, c), Vector3(0, 0, 1));
  EXPECT_EQ(nearest_weights(a, b, c, 0.5 * (a + b)), Vector3(0.5, 0.5, 0));
  EXPECT_EQ(nearest_weights(a, b, c, 0.5 * (b + c)), Vector3(0, 0.5, 0.5));
  EXPECT_EQ(nearest_weights(a, b, c, 0.5 * (a + c)), Vector3(0.5, 0, 0.5));
}

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
