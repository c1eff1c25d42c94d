// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/mesh_collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/expect_error.h"
#include "support/random_triangulations.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt {
namespace {

/// The mesh at a stage, with its vertices in the scan's order.
IndexedMesh stage_of(const MeshCollapse& collapse, const std::vector<Vector3>& points) {
  IndexedMesh mesh;
  std::vector<std::int32_t> places(points.size(), -1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!collapse.has_vertex(static_cast<std::int32_t>(i))) continue;
    places[i] = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(points[i]);
  }
  for (const std::int32_t f : collapse.present_triangles()) {
    const auto& [a, b, c] = collapse.triangles()[f];
    mesh.triangles.push_back({places[a], places[b], places[c]});
  }
  return mesh;
}

/// All there is to say about a stage.
struct Stage {
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> opposite;
  std::vector<std::int32_t> valences;

  explicit Stage(const MeshCollapse& mesh)
      : triangles(mesh.triangles()), opposite(mesh.opposite()) {
    for (std::size_t v = 0; v < mesh.points().size(); ++v) {
      const auto vertex = static_cast<std::int32_t>(v);
      std::int32_t valence = 0;
      if (mesh.has_vertex(vertex)) {
        mesh.visit_outgoing(vertex, [&](std::int32_t h) {
          EXPECT_EQ(origin_of(mesh.triangles(), h), vertex);
          ++valence;
        });
        EXPECT_EQ(valence, mesh.valence(vertex));
      }
      valences.push_back(valence);
    }
  }
  bool operator==(const Stage& other) const {
    return triangles == other.triangles && opposite == other.opposite && valences == other.valences;
  }
};

TEST(MeshCollapse, TakesBackExactly) {
  for (std::uint64_t seed = test::announced(1); seed < 30; ++seed) {
    const IndexedMesh mesh = test::random_triangulation(60, seed);
    MeshCollapse collapse(mesh, Execution(1));
    const Stage whole(collapse);
    EXPECT_EQ(whole.triangles, mesh.triangles);
    // Down in single steps, every stage kept; then up, compared with each.
    std::vector<Stage> stages;
    for (std::size_t left = mesh.points.size(); left > 4; --left) {
      collapse.collapse_to(left, Execution(1));
      ASSERT_EQ(collapse.vertex_count(), left);
      stages.emplace_back(collapse);
    }
    collapse.collapse_to(4, Execution(1));
    EXPECT_EQ(collapse.present_triangles().size(), 4U);
    while (!stages.empty()) {
      const MeshCollapse::Undone undone = collapse.undo();
      EXPECT_TRUE(collapse.has_vertex(undone.vertex));
      ASSERT_TRUE(Stage(collapse) == stages.back()) << "seed " << seed;
      stages.pop_back();
    }
    EXPECT_TRUE(Stage(collapse) == whole);
    EXPECT_EQ(collapse.collapses(), 0U);
  }
}

TEST(MeshCollapse, EveryStageIsAClosedSurface) {
  const IndexedMesh mesh = test::lumpy(4);
  MeshCollapse collapse(mesh, Execution(1));
  for (const std::size_t left : {2000U, 500U, 100U, 20U, 5U, 4U}) {
    collapse.collapse_to(left, Execution(1));
    const IndexedMesh stage = stage_of(collapse, mesh.points);
    EXPECT_EQ(stage.points.size(), left);
    EXPECT_EQ(stage.triangles.size(), 2 * left - 4);
    EXPECT_EQ(test::bad_edges(stage), 0U);
    for (const Vector3& p : stage.points) {
      EXPECT_NE(std::find(mesh.points.begin(), mesh.points.end(), p), mesh.points.end());
    }
  }
}

TEST(MeshCollapse, KeepsTheShape) {
  const IndexedMesh mesh = test::lumpy(5);
  const auto before = check_mesh(mesh, {}, Execution(1)).report;
  MeshCollapse collapse(mesh, Execution(1));
  collapse.collapse_to(500, Execution(1));
  const auto after = check_mesh(stage_of(collapse, mesh.points), {}, Execution(1)).report;
  // The chords of 500 nodes lose 660 / 500 % of a sphere's volume, and collapsed ones are uneven.
  EXPECT_NEAR(after.volume, before.volume, 0.03 * before.volume);
  EXPECT_NEAR(after.area, before.area, 0.03 * before.area);
}

TEST(MeshCollapse, TakesManyVerticesInRoundsAsWellAsOneByOne) {
  // 163,842 vertices go in rounds as far as 100,000 and then by the queue.
  const IndexedMesh mesh = test::lumpy(7);
  const auto before = check_mesh(mesh, {}, Execution(1)).report;
  std::vector<IndexedMesh> stages;
  for (const int threads : {1, 3}) {
    MeshCollapse collapse(mesh, Execution(threads));
    collapse.collapse_to(4000, Execution(threads));
    stages.push_back(stage_of(collapse, mesh.points));
    while (collapse.collapses() > 0) collapse.undo();
    EXPECT_EQ(collapse.triangles(), mesh.triangles);
  }
  EXPECT_EQ(stages[0].points, stages[1].points);
  EXPECT_EQ(stages[0].triangles, stages[1].triangles);
  EXPECT_EQ(stages[0].points.size(), 4000U);
  EXPECT_EQ(test::bad_edges(stages[0]), 0U);
  // As in KeepsTheShape, for eight times the nodes.
  const auto after = check_mesh(stages[0], {}, Execution(1)).report;
  EXPECT_NEAR(after.volume, before.volume, 0.004 * before.volume);
  EXPECT_NEAR(after.area, before.area, 0.004 * before.area);
  // Every vertex is seen by each round, so that none of them is left crowded: even cells, whose
  // sides are those of equal triangles within a factor of three.
  double longest = 0.0;
  for (const Triangle& t : stages[0].triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest =
          std::max(longest, (stages[0].points[t[k]] - stages[0].points[t[(k + 1) % 3]]).norm());
    }
  }
  const double even = std::sqrt(4.0 / std::sqrt(3.0) * before.area /
                                static_cast<double>(stages[0].triangles.size()));
  EXPECT_LT(longest, 3.0 * even);
}

TEST(MeshCollapse, StopsWhenAskedTo) {
  // While it is made ready, which takes tenths of a second of a million vertices: between the
  // steps of the check, once in 65,536 of 327,680 faces and of 163,842 vertices.
  const IndexedMesh mesh = test::sphere(7);
  test::expect_to_be_stopped(
      [&](const Execution& execution) {
        MeshCollapse(mesh, execution).collapse_to(mesh.points.size() - 1, execution);
      },
      "Collapsing the scan", 3 + 5 + 3);
}

TEST(MeshCollapse, TakesALongTimeForNoValence) {
  // Tens of seconds where a hub's ring is walked for each of its neighbours; no clock, the test's
  // time limit would tell.
  const IndexedMesh fan = test::double_fan(150000);
  MeshCollapse collapse(fan, Execution(1));
  collapse.collapse_to(4, Execution(1));
  EXPECT_EQ(collapse.vertex_count(), 4U);
  while (collapse.collapses() > 0) collapse.undo();
  EXPECT_EQ(collapse.triangles(), fan.triangles);
}

}  // namespace
}  // namespace wscvt
