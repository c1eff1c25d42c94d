// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

std::vector<TrianglePair> found_by_cgal(const IndexedMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  for (const Vector3& p : mesh.points) surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
  using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
  const auto vertex = [](std::int32_t v) { return Vertex(static_cast<std::uint32_t>(v)); };
  for (const auto& [a, b, c] : mesh.triangles) {
    surface.add_face(vertex(a), vertex(b), vertex(c));
  }
  using Face = CGAL::Surface_mesh<Kernel::Point_3>::Face_index;
  std::vector<std::pair<Face, Face>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  std::vector<TrianglePair> pairs;
  for (const auto& [first, second] : found) {
    pairs.emplace_back(std::minmax(static_cast<std::int32_t>(first.idx()),
                                   static_cast<std::int32_t>(second.idx())));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(SelfIntersections, ConvexBodiesHaveNone) {
  EXPECT_TRUE(self_intersections(test::sphere(3)).empty());
  EXPECT_TRUE(self_intersections(test::box(1.0, 2.0, 3.0)).empty());
}

TEST(SelfIntersections, AVertexPushedThroughTheOtherSideIsFound) {
  IndexedMesh mesh = test::sphere(2);
  const Vector3 apex = mesh.points[0];
  mesh.points[0] = -1.5 * apex;
  const auto pairs = self_intersections(mesh);
  ASSERT_FALSE(pairs.empty());
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a, b);
    const auto has_apex = [&](std::int32_t t) {
      const Triangle& corners = mesh.triangles[t];
      return corners[0] == 0 || corners[1] == 0 || corners[2] == 0;
    };
    EXPECT_TRUE(has_apex(a) || has_apex(b));
  }
  const auto vertices = vertices_of(pairs, mesh.triangles);
  EXPECT_EQ(vertices.front(), 0);
  EXPECT_LT(vertices.size(), mesh.points.size());
}

TEST(TrianglesMeet, ElsewhereThanInWhatTheyShare) {
  const std::vector<Vector3> points = {{0, 0, 0},     {2, 0, 0},   {0, 2, 0}, {0.5, 0.5, -1},
                                       {1, 0.5, 1},   {0.5, 1, 1}, {0, 0, 2}, {2, 2, 1},
                                       {0.5, 0.5, 0}, {2, 2, 0}};
  const Triangle floor = {0, 1, 2};
  EXPECT_TRUE(triangles_meet(points, floor, {3, 4, 5})) << "through its middle";
  EXPECT_FALSE(triangles_meet(points, floor, {4, 5, 6})) << "above it";
  EXPECT_FALSE(triangles_meet(points, floor, {1, 2, 3})) << "on the other side of an edge";
  EXPECT_FALSE(triangles_meet(points, floor, {0, 6, 7})) << "from a corner upwards";
  EXPECT_TRUE(triangles_meet(points, floor, {0, 3, 7})) << "from a corner, and through it";
  EXPECT_TRUE(triangles_meet(points, floor, floor));
  EXPECT_TRUE(triangles_meet(points, floor, {2, 1, 8})) << "folded onto it about an edge";
  EXPECT_FALSE(triangles_meet(points, floor, {2, 1, 9})) << "going on in its plane";
}

TEST(TrianglesMeet, AsAllPairsOfAMeshDo) {
  IndexedMesh mesh = test::sphere(2);
  mesh.points[0] *= -1.5;
  mesh.points[20] *= -0.9;
  std::vector<TrianglePair> pairs;
  for (std::size_t a = 0; a < mesh.triangles.size(); ++a) {
    for (std::size_t b = a + 1; b < mesh.triangles.size(); ++b) {
      if (!triangles_meet(mesh.points, mesh.triangles[a], mesh.triangles[b])) continue;
      pairs.emplace_back(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
    }
  }
  EXPECT_EQ(pairs, self_intersections(mesh));
}

TEST(SelfIntersections, AreThoseThatCgalFinds) {
  std::mt19937_64 random(test::announced(19));
  for (int body = 0; body < 20; ++body) {
    IndexedMesh mesh = test::sphere(2);
    // From whole meshes to a tangle; coordinates of three bits make planes and points coincide.
    const double size = 0.05 * body;
    std::uniform_real_distribution<double> shift(-size, size);
    for (Vector3& p : mesh.points) {
      p += Vector3(shift(random), shift(random), shift(random));
      if (body % 4 == 3) p = (4.0 * p).array().round();
    }
    EXPECT_EQ(self_intersections(mesh, Execution(2)), found_by_cgal(mesh)) << "body " << body;
  }
}

TEST(SelfIntersections, OfSomeTrianglesAreThosePairsThatHaveOne) {
  std::mt19937_64 random(test::announced(20));
  for (int body = 0; body < 20; ++body) {
    IndexedMesh mesh = test::sphere(2);
    std::uniform_real_distribution<double> shift(-0.04 * body, 0.04 * body);
    // Also far away, and with triangles without area.
    const Vector3 place = body % 2 == 0 ? Vector3(1e6, -1e6, 3.0) : Vector3::Zero();
    for (Vector3& p : mesh.points) {
      p += Vector3(shift(random), shift(random), shift(random));
      if (body % 4 == 3) p = (4.0 * p).array().round();
      p += place;
    }
    std::vector<std::int32_t> asked;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (random() % 5 == 0) asked.push_back(static_cast<std::int32_t>(t));
    }
    const auto is_asked = [&](std::int32_t t) {
      return std::binary_search(asked.begin(), asked.end(), t);
    };
    std::vector<TrianglePair> expected;
    for (const TrianglePair& pair : self_intersections(mesh)) {
      if (is_asked(pair.first) || is_asked(pair.second)) expected.push_back(pair);
    }
    EXPECT_EQ(self_intersections_of(asked, mesh, Execution(2)), expected) << "body " << body;
  }
}

// The boxes of the long ones would fill too many cells of the short ones' size.
TEST(SelfIntersections, OfLongAmongManyShortTrianglesAreAllFound) {
  std::mt19937_64 random(test::announced(21));
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto point = [&]() { return Vector3(place(random), place(random), place(random)); };
  IndexedMesh mesh;
  for (int t = 0; t < 1500; ++t) {
    const double size = t % 30 == 0 ? 1.0 : 0.02;
    const Vector3 middle = (1.0 - size) * point();
    const auto corner = static_cast<std::int32_t>(mesh.points.size());
    for (int k = 0; k < 3; ++k) mesh.points.emplace_back(middle + size * point());
    mesh.triangles.push_back({corner, corner + 1, corner + 2});
  }
  std::vector<TrianglePair> expected;
  for (std::int32_t a = 0; a < 1500; ++a) {
    for (std::int32_t b = a + 1; b < 1500; ++b) {
      if (triangles_meet(mesh.points, mesh.triangles[a], mesh.triangles[b])) {
        expected.emplace_back(a, b);
      }
    }
  }
  EXPECT_GT(expected.size(), 100U);
  EXPECT_EQ(self_intersections(mesh), expected);
}

TEST(SelfIntersections, StopsWhenCancelled) {
  const IndexedMesh mesh = test::sphere(6);
  test::expect_to_be_stopped(
      [&](const Execution& execution) { self_intersections(mesh, execution); },
      "Looking for intersecting triangles", 100);
}

IndexedMesh two_balls(int times) {
  return test::joined(test::sphere(times), test::moved(test::sphere(times), 0.9, {0.7, 0.1, 0.2}));
}

TEST(CrossingPairs, AreAllPairsOfASmallMesh) {
  const CrossingPairs pairs = crossing_pairs(two_balls(1));
  EXPECT_TRUE(pairs.is_all);
  EXPECT_EQ(pairs.count, self_intersections(two_balls(1)).size());
  EXPECT_GT(pairs.count, 0U);
  EXPECT_TRUE(crossing_sentence(crossing_pairs(test::sphere(3)), "it").empty());
}

TEST(CrossingPairs, OfALargeMeshAreSomeOfAllWhereverItLies) {
  for (const double shift : {0.0, 1e6}) {
    const IndexedMesh mesh = test::moved(two_balls(5), 1.0, {shift, -shift, 0});
    const CrossingPairs pairs = crossing_pairs(mesh);
    const std::size_t all = self_intersections(mesh).size();
    EXPECT_FALSE(pairs.is_all);
    // One of 82 faces was looked at, and each pair has two.
    EXPECT_GT(pairs.count, all / 90);
    EXPECT_LT(pairs.count, all / 20);
    EXPECT_EQ(crossing_pairs(test::moved(test::sphere(6), 1.0, {shift, -shift, 0})).count, 0U);
  }
}

}  // namespace

}  // namespace wscvt
