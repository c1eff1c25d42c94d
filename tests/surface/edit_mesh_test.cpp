// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/edit_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"

namespace wscvt {
namespace {

EditMesh sphere_to_edit(int times) {
  const IndexedMesh mesh = test::sphere(times);
  return EditMesh(mesh.points, mesh.triangles, Execution(1));
}

/// Fails unless links, firsts and degrees are those of the triangles.
void expect_linked(const EditMesh& mesh) {
  std::vector<int> degrees(mesh.points.size(), 0);
  for (std::size_t h = 0; h < mesh.opposite.size(); ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    ++degrees[mesh.origin(half_edge)];
    const std::int32_t g = mesh.opposite[h];
    ASSERT_GE(g, 0);
    EXPECT_EQ(mesh.opposite[g], half_edge);
    EXPECT_EQ(mesh.origin(g), mesh.target(half_edge));
    EXPECT_EQ(mesh.target(g), mesh.origin(half_edge));
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    EXPECT_EQ(mesh.degrees[v], degrees[v]) << v;
    if (degrees[v] == 0) continue;
    EXPECT_EQ(mesh.origin(mesh.first[v]), static_cast<std::int32_t>(v));
    int about = 0;
    mesh.around(static_cast<std::int32_t>(v), [&](std::int32_t) { ++about; });
    EXPECT_EQ(about, degrees[v]) << v;
  }
}

TEST(EditMesh, FlipsKeepItLinked) {
  EditMesh mesh = sphere_to_edit(2);
  constexpr int seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  int flips = 0;
  for (int i = 0; i < 300; ++i) {
    const auto h = static_cast<std::int32_t>(random() % mesh.opposite.size());
    const std::int32_t c = mesh.apex(h);
    const std::int32_t d = mesh.apex(mesh.opposite[h]);
    if (c == d || mesh.joined(c, d) || mesh.degrees[mesh.origin(h)] <= 3 ||
        mesh.degrees[mesh.target(h)] <= 3) {
      continue;
    }
    mesh.flip(h);
    ++flips;
    EXPECT_TRUE(mesh.joined(c, d));
  }
  EXPECT_GT(flips, 100);
  expect_linked(mesh);
}

TEST(EditMesh, ANodeIsTakenAwayAndPutOnAnEdgeElsewhere) {
  EditMesh mesh = sphere_to_edit(2);
  const std::int32_t h = mesh.first[20];
  const std::int32_t into = mesh.target(h);
  const int degree = mesh.degrees[20] + mesh.degrees[into] - 4;
  const std::array<std::int32_t, 2> free = mesh.collapse(h);
  EXPECT_EQ(mesh.degrees[into], degree);
  EXPECT_EQ(mesh.degrees[20], 0);
  std::int32_t edge = 0;
  const auto is_free = [&](std::int32_t half_edge) {
    const auto t = static_cast<std::int32_t>(face_of(half_edge));
    return t == free[0] || t == free[1];
  };
  while (is_free(edge) || is_free(mesh.opposite[edge])) ++edge;
  const std::int32_t a = mesh.origin(edge);
  const std::int32_t b = mesh.target(edge);
  const std::int32_t c = mesh.apex(edge);
  const std::int32_t d = mesh.apex(mesh.opposite[edge]);
  mesh.put_on_edge(20, edge, free);
  EXPECT_EQ(mesh.degrees[20], 4);
  EXPECT_FALSE(mesh.joined(a, b));
  for (const std::int32_t v : {a, b, c, d}) EXPECT_TRUE(mesh.joined(20, v));
  expect_linked(mesh);
}

TEST(EditMesh, MeansOfEdgesAreThoseOfABox) {
  const IndexedMesh box = test::box(1.0, 2.0, 3.0);
  const EditMesh mesh(box.points, box.triangles, Execution(1));
  // Each face of the box is two triangles with its sides and a diagonal.
  const double diagonals[] = {std::sqrt(5.0), std::sqrt(10.0), std::sqrt(13.0)};
  double edges = 0.0;
  for (const double diagonal : diagonals) edges += 4.0 * diagonal;
  edges += 4.0 * (1.0 + 2.0 + 1.0 + 3.0 + 2.0 + 3.0);
  EXPECT_NEAR(mean_edge_length(mesh), edges / 36.0, 1e-14);
  EXPECT_NEAR(mean_edge_ratio(mesh),
              (diagonals[0] / 1.0 + diagonals[1] / 1.0 + diagonals[2] / 2.0) / 3.0, 1e-14);
}

/// A thin round wedge: `around` nodes on its rim, which is at radius 1, and on both sheets a ring
/// at radius .6 and a middle. Node `around` + i lies on the upper ring, after the i-th of the rim.
EditMesh wedge(int around) {
  std::vector<Vector3> points;
  const auto ring = [&](double r, double z, double shift) {
    for (int i = 0; i < around; ++i) {
      const double a = 2.0 * pi * (i + shift) / around;
      points.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  };
  ring(1.0, 0.0, 0.0);
  ring(0.6, 0.04, 0.5);
  ring(0.6, -0.04, 0.5);
  points.emplace_back(0.0, 0.0, 0.05);
  points.emplace_back(0.0, 0.0, -0.05);
  std::vector<Triangle> triangles;
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    const int up = around + i;
    const int down = 2 * around + i;
    triangles.push_back({i, next, up});
    triangles.push_back({next, around + next, up});
    triangles.push_back({3 * around, up, around + next});
    triangles.push_back({next, i, down});
    triangles.push_back({2 * around + next, next, down});
    triangles.push_back({3 * around + 1, 2 * around + next, down});
  }
  return EditMesh(points, triangles, Execution(1));
}

std::vector<Vector3> outward(const EditMesh& mesh) {
  std::vector<Vector3> vectors(mesh.points.size(), Vector3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::int32_t v : mesh.triangles[t]) vectors[v] += mesh.normal(t);
  }
  return vectors;
}

std::int32_t half_edge(const EditMesh& mesh, std::int32_t from, std::int32_t to) {
  std::int32_t found = -1;
  mesh.around(from, [&](std::int32_t h) {
    if (mesh.target(h) == to) found = h;
  });
  return found;
}

TEST(DelaunayFlips, KeepLongEdgesOfARim) {
  // 11 nodes: edges of the rim are .56 long and their opposite angles obtuse.
  EditMesh mesh = wedge(11);
  for (Vector3& p : mesh.points) {
    if (p.head<2>().norm() < 0.7) p.head<2>() *= 1.5;
  }
  for (int pass = 0; pass < 3; ++pass) flip_to_delaunay(mesh, outward(mesh));
  for (int i = 0; i < 11; ++i) EXPECT_TRUE(mesh.joined(i, (i + 1) % 11)) << i;
}

TEST(DelaunayFlips, CloseANotchInARim) {
  EditMesh mesh = wedge(20);
  // A node of the upper ring joined to the lower one is a notch: the rim goes round by it.
  const std::int32_t up = 25;
  const std::int32_t down = 45;
  mesh.flip(half_edge(mesh, 5, 6));
  ASSERT_TRUE(mesh.joined(up, down));
  ASSERT_FALSE(mesh.joined(5, 6));
  flip_to_delaunay(mesh, outward(mesh));
  EXPECT_TRUE(mesh.joined(5, 6));
  EXPECT_FALSE(mesh.joined(up, down));
}

TEST(DelaunayFlips, FreeANodeThatTheRimGoesRoundBy) {
  // A node between two of the rim lies inwards, and both sheets meet in it. The edge from it to the
  // lower sheet becomes one of the rim, and it belongs to the upper sheet alone.
  EditMesh mesh = wedge(20);
  const std::int32_t inner = 0;
  const std::int32_t down = 59;
  mesh.flip(half_edge(mesh, inner, 40));  // one node of the lower sheet is left about it
  mesh.points[inner].head<2>() *= 0.85;
  ASSERT_TRUE(mesh.joined(inner, down));
  ASSERT_FALSE(mesh.joined(1, 19));
  flip_to_delaunay(mesh, outward(mesh));
  EXPECT_TRUE(mesh.joined(1, 19));
  EXPECT_FALSE(mesh.joined(inner, down));
  EXPECT_EQ(test::bad_edges({mesh.points, mesh.triangles}), 0u);
}

TEST(DelaunayFlips, MakeABallDelaunay) {
  const IndexedMesh ball = test::sphere(3);
  EditMesh mesh(ball.points, ball.triangles, Execution(1));
  for (const std::int32_t v : {20, 90, 200, 333, 500}) mesh.flip(mesh.first[v]);
  const auto obtuse = [&] {
    int count = 0;
    for (std::size_t h = 0; h < mesh.opposite.size(); ++h) {
      const auto e = static_cast<std::int32_t>(h);
      double angles = 0.0;
      for (const std::int32_t side : {e, mesh.opposite[h]}) {
        const Vector3 u = mesh.points[mesh.origin(side)] - mesh.points[mesh.apex(side)];
        const Vector3 w = mesh.points[mesh.target(side)] - mesh.points[mesh.apex(side)];
        angles += std::atan2(u.cross(w).norm(), u.dot(w));
      }
      if (angles > pi + 1e-5) ++count;
    }
    return count;
  };
  EXPECT_GE(obtuse(), 10);  // both half-edges of each
  int passes = 0;
  while (flip_to_delaunay(mesh, mesh.points) > 0 && passes < 10) ++passes;
  EXPECT_EQ(obtuse(), 0);
}

}  // namespace

}  // namespace wscvt
