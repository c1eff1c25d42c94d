// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/body_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "toolbox/convex/convex_body.h"
#include "toolbox/convex/cut_choice.h"
#include "toolbox/convex/cut_tree.h"
#include "toolbox/convex/face_cut.h"
#include "toolbox/convex/signed_grid.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

constexpr double on_plane = 1e-12;

double sum_of_volumes(const SolidCut& cut) {
  double sum = 0.0;
  for (const CutSolid& piece : cut.above) sum += piece.volume();
  for (const CutSolid& piece : cut.below) sum += piece.volume();
  return sum;
}

TEST(BodyCut, OfABoxGivesTwoBoxes) {
  const CutSolid box(test::moved(test::box(2.0, 3.0, 5.0), 1.0, Vector3(10.0, 0.0, 0.0)));
  const SolidCut cut = box.cut({Vector3::UnitX(), 9.7}, on_plane);
  ASSERT_EQ(cut.above.size(), 1U);
  ASSERT_EQ(cut.below.size(), 1U);
  EXPECT_NEAR(cut.above[0].volume(), 1.3 * 15.0, 1e-12);
  EXPECT_NEAR(cut.below[0].volume(), 0.7 * 15.0, 1e-12);
  for (const Vector3& p : cut.above[0].points()) EXPECT_GE(p.x(), 9.7 - 1e-12);
  for (const Vector3& p : cut.below[0].points()) EXPECT_LE(p.x(), 9.7 + 1e-12);
  EXPECT_TRUE(box.cut({Vector3::UnitX(), 12.0}, on_plane).above.empty());
}

TEST(BodyCut, OfARingAcrossGivesTwoLegsAndABow) {
  const IndexedMesh ring = test::torus(1.0, 0.3, 20);
  const SolidCut halves = CutSolid(ring).cut({Vector3(0.6, 0.8, 0.0), 0.1}, on_plane);
  ASSERT_EQ(halves.above.size(), 1U);
  ASSERT_EQ(halves.below.size(), 1U);
  EXPECT_NEAR(sum_of_volumes(halves), volume_of(ring, Execution(1)), 1e-12);
  const SolidCut slices = halves.above[0].cut({Vector3(0.6, 0.8, 0.0), 0.4}, on_plane);
  EXPECT_EQ(slices.above.size(), 1U) << "the bow";
  ASSERT_EQ(slices.below.size(), 2U) << "two legs, whose caps at one plane are two faces";
  EXPECT_GE(slices.below[0].volume(), slices.below[1].volume());
  EXPECT_NEAR(sum_of_volumes(slices), halves.above[0].volume(), 1e-12);
}

TEST(BodyCut, OfARingAlongItsPlaneHasACapWithAHole) {
  const IndexedMesh ring = test::torus(1.0, 0.3, 20);
  const CutPlane along{Vector3(0.05, -0.1, 1.0).normalized(), 0.02};
  const SolidCut halves = CutSolid(ring).cut(along, on_plane);
  ASSERT_EQ(halves.above.size(), 1U);
  ASSERT_EQ(halves.below.size(), 1U);
  EXPECT_NEAR(sum_of_volumes(halves), volume_of(ring, Execution(1)), 1e-12);
  // Across the hole of the cap: two halves of a ring's half.
  const SolidCut quarters = halves.above[0].cut({Vector3(0.8, -0.6, 0.0), 0.03}, on_plane);
  ASSERT_EQ(quarters.above.size(), 1U);
  ASSERT_EQ(quarters.below.size(), 1U);
  EXPECT_NEAR(sum_of_volumes(quarters), halves.above[0].volume(), 1e-12);
  // Across that one again: two legs, each with a cap of its own.
  const SolidCut legs = quarters.above[0].cut({Vector3(0.8, -0.6, 0.0), 0.4}, on_plane);
  EXPECT_EQ(legs.above.size(), 1U);
  EXPECT_EQ(legs.below.size(), 2U);
  // Beside the hole: its loop stays whole on one side.
  const SolidCut beside = halves.above[0].cut({Vector3(0.8, -0.6, 0.0), 0.9}, on_plane);
  EXPECT_EQ(beside.above.size() + beside.below.size(), 2U);
  EXPECT_NEAR(sum_of_volumes(beside), halves.above[0].volume(), 1e-12);
}

TEST(BodyCut, OfACupHasABottomInOnePiece) {
  // A box 4 x 4 x 3 with the hollow 2 x 2 x 2 from above: the hollow's bottom hangs on the cap.
  IndexedMesh cup;
  for (const auto& [half, z] :
       {std::pair(2.0, 0.0), std::pair(2.0, 3.0), std::pair(1.0, 3.0), std::pair(1.0, 1.0)}) {
    for (int k = 0; k < 4; ++k) {
      cup.points.emplace_back(k == 0 || k == 3 ? -half : half, k < 2 ? -half : half, z);
    }
  }
  for (std::int32_t ring = 0; ring < 12; ring += 4) {
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t next = (k + 1) % 4;
      cup.triangles.push_back({ring + k, ring + next, ring + next + 4});
      cup.triangles.push_back({ring + k, ring + next + 4, ring + k + 4});
    }
  }
  for (const Triangle& t : std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}, {12, 13, 14}, {12, 14, 15}})
    cup.triangles.push_back(t);
  ASSERT_NEAR(volume_of(cup, Execution(1)), 40.0, 1e-12);
  const SolidCut cut = CutSolid(cup).cut({Vector3::UnitZ(), 1.5}, on_plane);
  ASSERT_EQ(cut.above.size(), 1U);
  ASSERT_EQ(cut.below.size(), 1U);
  EXPECT_NEAR(cut.above[0].volume(), 1.5 * 12.0, 1e-12);
  EXPECT_NEAR(cut.below[0].volume(), 16.0 + 0.5 * 12.0, 1e-12);
}

TEST(BodyCut, ManyTimesLosesNothing) {
  const IndexedMesh body =
      test::transformed(test::lumpy(3), test::random_rotation(5), Vector3(40.0, -7.0, 3.0));
  std::vector<CutSolid> pieces = {CutSolid(body)};
  for (int k = 0; k < 12; ++k) {
    const Vector3 normal =
        Vector3(std::sin(1.7 * k), std::sin(2.3 * k + 1.0), std::sin(3.1 * k + 2.0)).normalized();
    std::vector<CutSolid> next;
    for (const CutSolid& piece : pieces) {
      // Every third plane passes through a point of the piece.
      const Vector3 through =
          k % 3 == 0 ? piece.points().back() : Vector3(40.0 + 0.02 * k, -7.0, 3.0);
      SolidCut cut = piece.cut({normal, normal.dot(through)}, on_plane);
      if (cut.above.empty() || cut.below.empty()) {
        next.push_back(piece);
        continue;
      }
      for (CutSolid& part : cut.above) next.push_back(std::move(part));
      for (CutSolid& part : cut.below) next.push_back(std::move(part));
    }
    pieces = std::move(next);
  }
  EXPECT_GT(pieces.size(), 100U);
  double volume = 0.0;
  for (const CutSolid& piece : pieces) volume += piece.volume();
  // Coordinates of 40 are rounded to 1e-14, areas are some hundreds.
  EXPECT_NEAR(volume, volume_of(body, Execution(1)), 1e-10);
}

TEST(BodyCut, NamesTheEdgesThatBendInward) {
  EXPECT_TRUE(CutSolid(test::box(1.0, 2.0, 3.0)).reflex_edges().empty());
  IndexedMesh dented = test::box(1.0, 2.0, 3.0);
  // A corner pushed far inward: the diagonals of its faces bend inward.
  dented.points[0] *= 0.4;
  const std::vector<CutSolid::ReflexEdge> reflexes = CutSolid(dented).reflex_edges();
  ASSERT_FALSE(reflexes.empty());
  for (const CutSolid::ReflexEdge& reflex : reflexes) {
    EXPECT_TRUE(reflex.edge[0] != reflex.edge[1]);
    EXPECT_NEAR(reflex.first.norm(), 1.0, 1e-12);
    const Vector3 along = dented.points[reflex.edge[1]] - dented.points[reflex.edge[0]];
    EXPECT_LT(reflex.first.cross(reflex.second).dot(along), 0.0);
  }
}

TEST(BodyCut, RefusesAnOpenMesh) {
  IndexedMesh open = test::box(1.0, 2.0, 3.0);
  open.triangles.pop_back();
  EXPECT_ERROR(CutSolid{open}, InvalidInput);
}

// Squares in squares: a frame, and another within its hole.
TEST(FaceCut, AHoleBelongsToTheSmallestLoopAboutIt) {
  std::vector<Vector3> points;
  FaceEdges edges;
  for (const double half : {8.0, 6.0, 3.0, 1.0}) {
    const auto first = static_cast<std::int32_t>(points.size());
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
      points.emplace_back(half * x, half * y, 0.5);
    }
    const bool is_hole = half == 6.0 || half == 1.0;
    for (std::int32_t k = 0; k < 4; ++k) {
      edges.push_back({first + (is_hole ? (k + 1) % 4 : k), first + (is_hole ? k : (k + 1) % 4)});
    }
  }
  std::vector<double> areas;
  for (const FaceEdges& face : faces_of(points, edges, Vector3::UnitZ())) {
    areas.push_back(0.5 * doubled_area(points, face).z());
  }
  EXPECT_EQ(areas, (std::vector<double>{256.0 - 144.0, 36.0 - 4.0}));
}

// A piece that fills its hull within the tolerance needs no cut.
TEST(CutTree, PiecesWithinTheToleranceStayWhole) {
  const IndexedMesh body = test::torus(1.0, 0.35, 8);
  const SignedGrid grid(body, 30, Execution(1));
  const HullCost narrow(grid, 0.01);
  CutTree cut(body, Eigen::Matrix3d::Identity(), narrow);
  cut.cut(4, Execution(1));
  EXPECT_GT(cut.groups().size(), 1U);
  const HullCost wide(grid, 2.0);
  CutTree whole(body, Eigen::Matrix3d::Identity(), wide);
  whole.cut(4, Execution(1));
  EXPECT_EQ(whole.groups().size(), 1U);
}

TEST(CutTree, MovedPlanesCostLessAndTheirPiecesFillTheGrain) {
  Eigen::Matrix3d linear;
  linear << 1.3, 0.2, 0.1, -0.1, 1.0, 0.3, 0.05, -0.2, 0.9;
  const IndexedMesh body = test::transformed(test::torus(1.0, 0.35, 10), linear);
  const SignedGrid grid(body, 40, Execution(2));
  const HullCost cost(grid, 0.01);
  CutTree tree(body, Eigen::Matrix3d::Identity(), cost);
  tree.cut(5, Execution(2));
  std::vector<PieceGroup> groups = tree.groups();
  ASSERT_GE(groups.size(), 5U);
  const double before = total_cost(groups);
  tree.move_planes(groups, Execution(2));
  EXPECT_LT(total_cost(groups), 0.95 * before);
  double volume = 0.0;
  for (const PieceGroup& group : groups) volume += group.volume;
  EXPECT_NEAR(volume, volume_of(body, Execution(1)), 1e-10);
  // What the groups say of themselves is what their pieces are.
  EXPECT_NEAR(total_cost(tree.groups()), total_cost(groups), 1e-9 * before);
  // Another mesh of the grain: its own hulls and volumes.
  const IndexedMesh finer = test::transformed(test::torus(1.0, 0.35, 30), linear);
  volume = 0.0;
  for (const PieceGroup& group : tree.groups_of(finer, groups, Execution(1))) {
    ASSERT_FALSE(group.body.empty());
    EXPECT_GE(group.body.volume, group.volume);
    volume += group.volume;
  }
  EXPECT_NEAR(volume, volume_of(finer, Execution(1)), 1e-10);
}

}  // namespace
}  // namespace wscvt
