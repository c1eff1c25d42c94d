// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fragment/cell_complex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <unordered_set>
#include <vector>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

CellComplex cut(const IndexedMesh& mesh, const std::vector<Vector3>& points) {
  std::vector<CellSite> sites;
  for (const Vector3& p : points) sites.push_back({p, 0.0});
  return {mesh, sites, Execution(1)};
}

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

/// Number of directed edges of a cell that no face of it runs back along.
std::size_t open_edges(const CellComplex& complex, std::int32_t cell) {
  std::map<FaceEdge, int> uses;
  for (const CellComplex::Face& face : complex.faces()) {
    for (const auto& [a, b] : face.edges) {
      if (face.front == cell) ++uses[{a, b}];
      if (face.back == cell) ++uses[{b, a}];
    }
  }
  std::size_t open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge[1], edge[0]});
    if (back == uses.end() || back->second != count) ++open;
  }
  return open;
}

TEST(CellComplex, OfABoxHasTheCellsOfAGrid) {
  // Eight sites about the middle: all planes meet in one point, and none has any choice.
  std::vector<Vector3> points;
  for (int k = 0; k < 8; ++k) {
    points.emplace_back((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.75 : -0.75,
                        (k & 4) != 0 ? 1.25 : -1.25);
  }
  const CellComplex complex = cut(test::box(2.0, 3.0, 5.0), points);
  for (const double volume : complex.volumes()) EXPECT_NEAR(volume, 30.0 / 8.0, 1e-12);
  for (std::int32_t c = 0; c < 8; ++c) EXPECT_EQ(open_edges(complex, c), 0U);
}

TEST(CellComplex, StaysClosedForSitesOnALattice) {
  // Every point of the body's box lattice is as far from four or eight sites: nothing but ties.
  const IndexedMesh body = test::box(2.0, 2.0, 2.0);
  std::vector<Vector3> points;
  for (int k = 0; k < 64; ++k) {
    points.emplace_back(0.5 * (k % 4) - 0.75, 0.5 * (k / 4 % 4) - 0.75, 0.5 * (k / 16) - 0.75);
  }
  const CellComplex complex = cut(body, points);
  for (std::int32_t c = 0; c < 64; ++c) {
    EXPECT_EQ(open_edges(complex, c), 0U);
    EXPECT_NEAR(complex.volumes()[static_cast<std::size_t>(c)], 0.125, 1e-9);
  }
}

TEST(CellComplex, HoldsThePointsNearestToItsSites) {
  std::mt19937_64 engine(test::announced(17));
  std::uniform_real_distribution<double> within(-0.8, 0.8);
  std::vector<CellSite> sites;
  for (int k = 0; k < 25; ++k) {
    sites.push_back({{within(engine), within(engine), within(engine)}, 0.05 * within(engine)});
  }
  const IndexedMesh body = test::lumpy(3);
  const CellComplex complex(body, sites, Execution(1));
  EXPECT_NEAR(sum(complex.volumes()), volume_of(body, Execution(1)), 1e-12);
  for (const CellComplex::Face& face : complex.faces()) {
    for (const auto& [a, b] : face.edges) {
      const Vector3& p = complex.points()[a];
      double least = 1e300;
      for (const CellSite& site : sites) {
        least = std::min(least, (p - site.point).squaredNorm() - site.weight);
      }
      for (const std::int32_t cell : {face.front, face.back}) {
        if (cell < 0) continue;
        const CellSite& own = sites[static_cast<std::size_t>(cell)];
        EXPECT_NEAR((p - own.point).squaredNorm() - own.weight, least, 1e-11);
      }
    }
  }
}

TEST(CellComplex, JoinsTheSmallerLegOfARingToItsNeighbour) {
  // The middle slab cuts the ring into two legs of unlike size, because the ring is cut aslant.
  const IndexedMesh ring = test::torus(1.0, 0.25, 40);
  const std::vector<Vector3> points = {{-0.9, 0.1, 0.0}, {0.0, 0.2, 0.0}, {0.9, 0.3, 0.0}};
  CellComplex complex = cut(ring, points);
  const std::vector<double> before = complex.volumes();
  const CellComplex::Moved moved = complex.join_pieces();
  EXPECT_EQ(moved.pieces, 1U);
  const std::vector<double> after = complex.volumes();
  EXPECT_NEAR(sum(after), volume_of(ring, Execution(1)), 1e-12);
  EXPECT_NEAR(before[1] - after[1], moved.volume, 1e-12);
  EXPECT_GT(after[1], moved.volume) << "the larger leg stays";
  for (std::int32_t c = 0; c < 3; ++c) EXPECT_EQ(open_edges(complex, c), 0U);
  EXPECT_EQ(complex.join_pieces().pieces, 0U) << "now each cell is one piece";
}

/// Area of the walls; of those between two cells alone if they are given.
double wall_area(const CellComplex& complex, std::int32_t one = -1, std::int32_t other = -1) {
  double area = 0.0;
  for (const CellComplex::Face& face : complex.faces()) {
    if (face.edges.empty() || !face.is_wall()) continue;
    if (one >= 0 && std::minmax(face.front, face.back) != std::minmax(one, other)) continue;
    area += 0.5 *
            doubled_area(complex.points(), face.edges.data(), face.edges.data() + face.edges.size())
                .norm();
  }
  return area;
}

TEST(CellComplex, JoinsAPieceBehindItsLargerWall) {
  const IndexedMesh ring = test::torus(1.0, 0.25, 40);
  for (const double side : {-1.0, 1.0}) {
    CellComplex complex =
        cut(ring, {{side * -0.9, 0.1, 0.0}, {0.0, 0.2, 0.0}, {side * 0.7, 0.6, 0.0}});
    const double before = wall_area(complex);
    ASSERT_EQ(complex.join_pieces().pieces, 1U);
    // The piece's wall to its new cell is gone; its other one is now between the outer cells.
    EXPECT_GT(before - wall_area(complex), wall_area(complex, 0, 2)) << side;
    EXPECT_GT(wall_area(complex, 0, 2), 0.0);
  }
}

TEST(CellComplex, TellsTheVolumeOfAllPiecesThatMoved) {
  const IndexedMesh ring = test::torus(1.0, 0.25, 40);
  CellComplex complex =
      cut(ring, {{-0.9, 0.1, 0.0}, {-0.3, 0.15, 0.0}, {0.3, 0.2, 0.0}, {0.9, 0.3, 0.0}});
  const std::vector<double> before = complex.volumes();
  const CellComplex::Moved moved = complex.join_pieces();
  ASSERT_EQ(moved.pieces, 2U);
  const std::vector<double> after = complex.volumes();
  EXPECT_NEAR(before[1] - after[1] + before[2] - after[2], moved.volume, 1e-12);
}

TEST(CellComplex, RefusesOpenMeshesAndEqualSites) {
  IndexedMesh open = test::lumpy(1);
  open.triangles.pop_back();
  EXPECT_ERROR(cut(open, {Vector3::Zero()}), InvalidInput);
  EXPECT_ERROR(cut(test::lumpy(1), {Vector3::Zero(), Vector3::Zero()}), InvalidInput);
}

TEST(FaceTriangles, KeepEdgesAndAreaOfAFrameWithCornersOnItsSides) {
  // A square of 16 points with a square hole of 8, turned in space.
  std::vector<Vector3> points;
  FaceEdges edges;
  const auto add_loop = [&](double half, int per_side, bool reversed) {
    const auto first = static_cast<std::int32_t>(points.size());
    const std::vector<Vector3> corners = {
        {-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
    for (std::size_t c = 0; c < 4; ++c) {
      for (int k = 0; k < per_side; ++k) {
        const double part = static_cast<double>(k) / per_side;
        points.push_back((1.0 - part) * corners[c] + part * corners[(c + 1) % 4]);
      }
    }
    const auto count = static_cast<std::int32_t>(points.size()) - first;
    for (std::int32_t k = 0; k < count; ++k) {
      const std::int32_t a = first + k;
      const std::int32_t b = first + (k + 1) % count;
      edges.push_back(reversed ? FaceEdge{b, a} : FaceEdge{a, b});
    }
  };
  add_loop(2.0, 4, false);
  add_loop(0.5, 2, true);
  const Eigen::Matrix3d turn = test::random_rotation(2);
  for (Vector3& p : points) p = turn * p;
  const Vector3 normal = turn.col(2);
  std::unordered_set<std::uint64_t> taken;
  for (const auto& [a, b] : edges) taken.insert(undirected_key(a, b));
  const std::vector<Triangle> triangles = face_triangles(points, edges, normal, taken);
  EXPECT_EQ(triangles.size(), 24U) << "points + 2 holes - 2";
  std::map<FaceEdge, int> uses;
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const Vector3 doubled = doubled_area_normal(points[a], points[b], points[c]);
    EXPECT_GT(doubled.dot(normal), 1e-3) << "none without area, all turned as the face";
    area += 0.5 * doubled.dot(normal);
    for (const FaceEdge& e : {FaceEdge{a, b}, FaceEdge{b, c}, FaceEdge{c, a}}) ++uses[e];
  }
  EXPECT_NEAR(area, 15.0, 1e-12);
  for (const FaceEdge& edge : edges) {
    EXPECT_EQ(uses[edge], 1);
    EXPECT_EQ(uses.count({edge[1], edge[0]}), 0U);
    uses.erase(edge);
  }
  for (const auto& [edge, count] : uses) EXPECT_EQ(uses.count({edge[1], edge[0]}), 1U);
}

TEST(FaceTriangles, CrossNoSlitBetweenHoles) {
  // A square with a slit from above, and a hole on either side: the corner nearest to the second
  // hole is one of the first, behind the slit.
  const std::vector<std::vector<Vector3>> loops = {
      {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {5.1, 10, 0}, {5, 1, 0}, {4.9, 10, 0}, {0, 10, 0}},
      {{4.2, 5, 0}, {4.3, 6, 0}, {4.6, 5.5, 0}},
      {{5.4, 5.5, 0}, {5.7, 6.1, 0}, {5.8, 5, 0}}};
  std::vector<Vector3> points;
  FaceEdges edges;
  double expected = 0.0;
  for (const std::vector<Vector3>& loop : loops) {
    const auto first = static_cast<std::int32_t>(points.size());
    const auto count = static_cast<std::int32_t>(loop.size());
    for (std::int32_t k = 0; k < count; ++k) {
      const Vector3& p = loop[static_cast<std::size_t>(k)];
      const Vector3& next = loop[static_cast<std::size_t>((k + 1) % count)];
      expected += 0.5 * p.cross(next).z();
      points.push_back(p);
      edges.push_back({first + k, first + (k + 1) % count});
    }
  }
  std::unordered_set<std::uint64_t> taken;
  for (const auto& [a, b] : edges) taken.insert(undirected_key(a, b));
  double area = 0.0;
  for (const auto& [a, b, c] : face_triangles(points, edges, Vector3::UnitZ(), taken)) {
    const double doubled = doubled_area_normal(points[a], points[b], points[c]).z();
    EXPECT_GT(doubled, 0.0);
    area += 0.5 * doubled;
  }
  EXPECT_NEAR(area, expected, 1e-12);
}

TEST(FaceTriangles, DoNotTakeAnEdgeThatAnotherFaceHas) {
  const std::vector<Vector3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const FaceEdges edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  for (const bool other : {false, true}) {
    std::unordered_set<std::uint64_t> taken = {other ? undirected_key(1, 3) : undirected_key(2, 0)};
    const std::vector<Triangle> triangles = face_triangles(points, edges, Vector3::UnitZ(), taken);
    ASSERT_EQ(triangles.size(), 2U);
    EXPECT_EQ(taken.count(undirected_key(0, 2)), 1U);
    EXPECT_EQ(taken.count(undirected_key(1, 3)), 1U) << "one was taken, the other is new";
  }
}

TEST(PointsIn, FillABodyEvenly) {
  const IndexedMesh body = test::torus(1.0, 0.4, 60);
  const double volume = volume_of(body, Execution(1));
  const std::vector<Vector3> points = points_in(body, volume, 5000);
  // The points at the surface count as in or out: some per cent of the square root's kind.
  EXPECT_NEAR(static_cast<double>(points.size()) / 5000.0, 1.0, 0.02);
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : points) {
    mean += p / static_cast<double>(points.size());
    EXPECT_LT(std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z()), 0.4 + 1e-9);
  }
  EXPECT_LT(mean.norm(), 0.02);
}

}  // namespace
}  // namespace wscvt
