// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/components.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"

namespace wscvt {
namespace {

/// Three balls apart from each other, their faces in one random order. `ball_of` gets each face's.
IndexedMesh three_balls(std::vector<int>& ball_of) {
  IndexedMesh mesh;
  std::vector<std::pair<Triangle, int>> faces;
  for (int ball = 0; ball < 3; ++ball) {
    IndexedMesh part = test::subdivided(test::icosahedron(), 2 + ball % 2);
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (const Vector3& p : part.points) mesh.points.emplace_back(p + Vector3(5.0 * ball, 0, 0));
    for (const Triangle& t : part.triangles) {
      faces.push_back({{t[0] + first, t[1] + first, t[2] + first}, ball});
    }
  }
  std::mt19937_64 engine(test::announced(5));
  for (std::size_t i = faces.size(); i-- > 1;) std::swap(faces[i], faces[engine() % (i + 1)]);
  for (const auto& [triangle, ball] : faces) {
    mesh.triangles.push_back(triangle);
    ball_of.push_back(ball);
  }
  return mesh;
}

Components components_of(const IndexedMesh& mesh) {
  return find_components(mesh, edge_rings(mesh, Execution(2)), Execution(2));
}

TEST(Components, AreNumberedByTheirFirstFaces) {
  std::vector<int> ball_of;
  const IndexedMesh mesh = three_balls(ball_of);
  const Components found = components_of(mesh);
  std::vector<int> seen;  // the balls in the order of their first faces
  std::vector<std::size_t> faces(3, 0);
  for (std::size_t f = 0; f < ball_of.size(); ++f) {
    const auto number = static_cast<std::size_t>(found.of_face[f]);
    ASSERT_LE(number, seen.size());
    if (number == seen.size()) seen.push_back(ball_of[f]);
    EXPECT_EQ(seen[number], ball_of[f]) << f;
    EXPECT_EQ(found.turned[f], 0) << f;
    ++faces[number];
  }
  ASSERT_EQ(found.list.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(found.list[c].faces, faces[c]);
    EXPECT_EQ(found.list[c].boundary_edges, 0U);
    EXPECT_TRUE(found.list[c].orientable);
    // A regular icosahedron's, whose edge is 1 / sin(72 degrees).
    EXPECT_NEAR(found.list[c].volume,
                5.0 * (3.0 + std::sqrt(5.0)) / 12.0 / std::pow(std::sin(0.4 * pi), 3), 1e-12);
  }
}

TEST(Components, OfMeshesWithATurnedFaceAreTheSame) {
  std::vector<int> ball_of;
  const IndexedMesh mesh = three_balls(ball_of);
  const Components expected = components_of(mesh);
  // A face that is not its ball's first, so that it alone differs from that one.
  const std::size_t turned = ball_of.size() - 1;
  IndexedMesh other = mesh;
  std::swap(other.triangles[turned][1], other.triangles[turned][2]);
  const Components found = components_of(other);
  EXPECT_EQ(found.of_face, expected.of_face);
  for (std::size_t f = 0; f < ball_of.size(); ++f) {
    EXPECT_EQ(found.turned[f] != 0, f == turned) << f;
  }
  for (std::size_t c = 0; c < expected.list.size(); ++c) {
    EXPECT_EQ(found.list[c].faces, expected.list[c].faces);
    EXPECT_TRUE(found.list[c].orientable);
    // Sums of a thousand terms up to their size, in one order: roundings of a turned one.
    EXPECT_NEAR(found.list[c].volume, expected.list[c].volume, 1e-12);
  }
}

TEST(Components, CountAnOpenBoundary) {
  std::vector<int> ball_of;
  IndexedMesh mesh = three_balls(ball_of);
  mesh.triangles.pop_back();
  const Components found = components_of(mesh);
  ASSERT_EQ(found.list.size(), 3U);
  std::size_t edges = 0;
  for (const Component& component : found.list) edges += component.boundary_edges;
  EXPECT_EQ(edges, 3U);
}

}  // namespace

namespace {

TEST(Enclosure, TellsInsideFromOutside) {
  std::mt19937_64 engine(test::announced(3));
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::vector<Vector3> points;
  std::vector<char> expected;
  while (points.size() < 2000) {
    Vector3 p(place(engine), place(engine), place(engine));
    // Every third above a vertex or an edge of the box, seen along the axis.
    if (points.size() % 3 == 0) p.x() = 0.5;
    if (points.size() % 6 == 0) p.y() = -0.5;
    if (std::abs(p.cwiseAbs().maxCoeff() - 0.5) < 1e-9) p *= 0.9;
    points.push_back(p);
    expected.push_back(p.cwiseAbs().maxCoeff() < 0.5 ? 1 : 0);
  }
  const IndexedMesh box = test::box(1, 1, 1);
  EXPECT_EQ(are_inside(box, points, Execution(1)), expected);
  EXPECT_EQ(are_inside(box, points, Execution(2)), expected);
  IndexedMesh inside_out = box;
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(are_inside(inside_out, points, Execution(1)), expected);
}

TEST(Enclosure, KnowsPointsInLineWithVertices) {
  // Beside each vertex of a ball, whose facets are at most 0.03 deep, points with its x.
  const IndexedMesh ball = test::shuffled(test::sphere(2), 5);
  std::vector<Vector3> points;
  std::vector<char> expected;
  for (const Vector3& v : ball.points) {
    for (const double y : {-0.9, -0.4, 0.0, 0.3, 0.8}) {
      for (const double z : {-0.7, -0.2, 0.1, 0.6}) {
        const Vector3 p(v.x(), y, z);
        if (std::abs(p.norm() - 0.985) < 0.02) continue;
        points.push_back(p);
        expected.push_back(p.norm() < 1.0 ? 1 : 0);
      }
    }
  }
  EXPECT_EQ(are_inside(ball, points, Execution(1)), expected);
}

TEST(Enclosure, KnowsTheHoleOfATorus) {
  const IndexedMesh torus = test::torus(3.0, 1.0, 60);
  const std::vector<Vector3> points = {{0, 0, 0}, {3, 0, 0}, {-3, 0, 0.5}, {0, 3, 0}, {0, 0, 5}};
  EXPECT_EQ(are_inside(torus, points, Execution(1)), (std::vector<char>{0, 1, 1, 1, 0}));
}

}  // namespace
}  // namespace wscvt
