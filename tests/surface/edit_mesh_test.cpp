// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/edit_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/test_shapes.h"

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

}  // namespace
}  // namespace wscvt
