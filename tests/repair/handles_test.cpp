// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "grains/bent_grain.h"
#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "support/voxel_body.h"
#include "wscvt/base/error.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {
namespace {

int counted_genus(const IndexedMesh& mesh) {
  return check_mesh(mesh, {}, Execution(1)).report.genus;
}

/// Whether a segment and a triangle without a common vertex meet, by exact signs.
bool segment_meets(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b,
                   const Vector3& c) {
  const int above_p = orientation(a, b, c, p);
  const int above_q = orientation(a, b, c, q);
  // Within the plane of the triangle nothing is crossed.
  if (above_p * above_q > 0 || (above_p == 0 && above_q == 0)) return false;
  const int ab = orientation(p, q, a, b);
  const int bc = orientation(p, q, b, c);
  const int ca = orientation(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// Pairs of triangles without a common vertex that meet, among those within `reach` of a place.
int meeting_pairs(const IndexedMesh& mesh, const Vector3& place, double reach) {
  std::vector<Triangle> near;
  for (const Triangle& t : mesh.triangles) {
    if ((mesh.points[t[0]] - place).norm() < reach) near.push_back(t);
  }
  EXPECT_GT(near.size(), 10U);
  int count = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = 0; j < near.size(); ++j) {
      const Triangle& s = near[i];
      const Triangle& t = near[j];
      bool apart = i == j;
      for (const std::int32_t v : s) {
        apart = apart || std::find(t.begin(), t.end(), v) != t.end();
      }
      for (std::size_t k = 0; k < 3 && !apart; ++k) {
        if (segment_meets(mesh.points[s[k]], mesh.points[s[(k + 1) % 3]], mesh.points[t[0]],
                          mesh.points[t[1]], mesh.points[t[2]])) {
          ++count;
          break;
        }
      }
    }
  }
  return count;
}

TEST(Handles, CutsABridge) {
  const IndexedMesh mesh = test::ball_with_a_bridge();
  ASSERT_EQ(counted_genus(mesh), 1);
  const HandleFreeMesh result = remove_handles(mesh, {}, Execution(1));
  EXPECT_EQ(counted_genus(result.mesh), 0);
  EXPECT_EQ(test::bad_edges(result.mesh), 0U);
  ASSERT_EQ(result.report.cut.size(), 1U);
  const CutHandle& cut = result.report.cut[0];
  // Once round the tube of radius 0.08; along edges it is somewhat longer.
  EXPECT_NEAR(cut.length, 2.0 * test::pi * 0.08, 0.3 * 2.0 * test::pi * 0.08);
  EXPECT_GT(test::bridge(cut.place), 0.0);
  EXPECT_LT(std::abs(result.report.volume_change), 1e-3);
  // All that is far from the cut is as it was.
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if ((mesh.points[i] - cut.place).norm() > 0.25) {
      EXPECT_EQ(result.mesh.points[i], mesh.points[i]);
    }
  }
}

TEST(Handles, ClosesATunnel) {
  const IndexedMesh mesh = test::ball_with_a_tunnel();
  ASSERT_EQ(counted_genus(mesh), 1);
  const HandleFreeMesh result = remove_handles(mesh, {}, Execution(1));
  EXPECT_EQ(counted_genus(result.mesh), 0);
  ASSERT_EQ(result.report.cut.size(), 1U);
  EXPECT_NEAR(std::hypot(result.report.cut[0].place.x() + 0.8, result.report.cut[0].place.y()), 0.0,
              0.05);
  EXPECT_NEAR(result.report.volume_change, 0.0, 1e-3);
}

TEST(Handles, PartsTheTwoCaps) {
  for (const IndexedMesh& mesh : {test::ball_with_a_bridge(), test::ball_with_a_tunnel()}) {
    const HandleFreeMesh result = remove_handles(mesh, {}, Execution(1));
    EXPECT_EQ(meeting_pairs(result.mesh, result.report.cut[0].place, 0.4), 0);
  }
}

TEST(Handles, CutsTheShortestFirst) {
  const IndexedMesh mesh = test::body_of_depth([](const Vector3& p) {
    const double other = test::bridge(Vector3(-p.z(), p.x(), p.y()));
    return std::max({test::drilled(p), test::bridge(p), other + 0.03});
  });
  ASSERT_EQ(counted_genus(mesh), 3);
  HandleOptions options;
  options.length_limit = 1.0;
  const HandleFreeMesh result = remove_handles(mesh, options, Execution(1));
  EXPECT_EQ(counted_genus(result.mesh), 0);
  ASSERT_EQ(result.report.cut.size(), 3U);
  EXPECT_LT(result.report.cut[0].length, result.report.cut[1].length);
  EXPECT_LT(result.report.cut[1].length, result.report.cut[2].length);
  // The tunnel, the bridge of radius 0.08 and that of 0.11.
  const auto is_at = [&](std::size_t i, const Vector3& direction, double distance) {
    return result.report.cut[i].place.dot(direction) > distance;
  };
  EXPECT_TRUE(is_at(0, Vector3::UnitX(), 1.0) || is_at(1, Vector3::UnitX(), 1.0));
  EXPECT_TRUE(is_at(0, -Vector3::UnitX(), 0.7) || is_at(1, -Vector3::UnitX(), 0.7));
  EXPECT_TRUE(is_at(2, -Vector3::UnitZ(), 1.0));
}

TEST(Handles, AreTheSameInAnyOrderOfTheScan) {
  // A ball of voxels with pores, whose corners are moved so that no two loops are equally long.
  IndexedMesh porous = test::voxel_body(24, [](int x, int y, int z) {
    const Vector3 p(x - 11.3, y - 11.6, z - 12.1);
    const double wave = std::sin(1.1 * p.x() + 0.4 * p.y()) + std::sin(0.9 * p.y() - 0.5 * p.z()) +
                        std::sin(1.2 * p.z() + 0.3 * p.x());
    return p.norm() < 10.0 && wave < 0.8;
  });
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> step(-0.2, 0.2);
  for (Vector3& point : porous.points) {
    for (Eigen::Index k = 0; k < 3; ++k) point[k] += step(engine);
  }
  const IndexedMesh scan = check_mesh(porous, {}, Execution(1)).mesh;
  ASSERT_GT(genus_of(scan), 30U);
  const HandleReport given = remove_handles(scan, HandleOptions(), Execution(1)).report;
  ASSERT_GT(given.cut.size(), 30U);
  for (const std::uint64_t seed : {1U, 2U}) {
    const HandleReport other =
        remove_handles(test::shuffled(scan, seed), HandleOptions(), Execution(1)).report;
    EXPECT_EQ(other.kept, given.kept) << seed;
    EXPECT_NEAR(other.next.length, given.next.length, 1e-9) << seed;
    ASSERT_EQ(other.cut.size(), given.cut.size()) << seed;
    for (std::size_t k = 0; k < given.cut.size(); ++k) {
      EXPECT_NEAR(other.cut[k].length, given.cut[k].length, 1e-9) << seed << ", " << k;
    }
  }
}

TEST(Handles, ARingKeepsItsHoleBelowTheLimit) {
  const IndexedMesh ring = test::torus(1.0, 0.4, 24);
  const double volume = 2.0 * test::pi * test::pi * 0.16;
  const HandleFreeMesh kept = remove_handles(ring, {}, Execution(1));
  EXPECT_EQ(kept.mesh.points, ring.points);
  EXPECT_EQ(kept.mesh.triangles, ring.triangles);
  EXPECT_TRUE(kept.report.cut.empty());
  EXPECT_EQ(kept.report.kept, 1);
  // The loop that was found: once round the tube.
  EXPECT_NEAR(kept.report.next.length, 24.0 * 2.0 * 0.4 * std::sin(test::pi / 24.0), 1e-12);
  HandleOptions options;
  options.length_limit = 1.1 * 2.0 * test::pi * 0.4 / std::cbrt(3.0 * volume / (4.0 * test::pi));
  const HandleFreeMesh cut = remove_handles(ring, options, Execution(1));
  EXPECT_EQ(counted_genus(cut.mesh), 0);
  EXPECT_EQ(cut.report.cut.size(), 1U);
  EXPECT_EQ(cut.report.kept, 0);
}

TEST(Handles, LimitIsInEquivalentRadiiOfTheGrainHoweverLarge) {
  // The shortest loop of a ring goes once round its tube, a regular 24-gon.
  const double loop = 24.0 * 2.0 * 0.4 * std::sin(test::pi / 24.0);
  for (const double scale : {0.01, 1.0, 40.0}) {
    SCOPED_TRACE(scale);
    const IndexedMesh ring = test::transformed(
        test::torus(1.0, 0.4, 24), scale * Eigen::Matrix3d::Identity(), scale * Vector3(5, -3, 2));
    const double radius = check_mesh(ring, {}, Execution(1)).report.equivalent_radius;
    HandleOptions options;
    options.length_limit = loop * scale / radius * (1.0 - 1e-9);
    EXPECT_EQ(remove_handles(ring, options, Execution(1)).report.kept, 1);
    options.length_limit = loop * scale / radius * (1.0 + 1e-9);
    const HandleFreeMesh cut = remove_handles(ring, options, Execution(1));
    ASSERT_EQ(cut.report.cut.size(), 1U);
    EXPECT_NEAR(cut.report.cut[0].length, loop * scale, 1e-12 * scale);
    EXPECT_EQ(cut.report.cut[0].edges, 24);
    // The middle of the loop lies on the ring within the tube.
    const Vector3 place = cut.report.cut[0].place / scale - Vector3(5, -3, 2);
    EXPECT_NEAR(place.head<2>().norm(), 1.0, 1e-9);
    EXPECT_NEAR(place.z(), 0.0, 1e-9);
    // What is reported of the volume is what check_mesh sees.
    EXPECT_NEAR(
        cut.report.volume_change,
        std::pow(check_mesh(cut.mesh, {}, Execution(1)).report.equivalent_radius / radius, 3) - 1.0,
        1e-9);
  }
}

TEST(Handles, SaysHowManyAreLeft) {
  // A thin handle on a ring: the one is cut, the other is the ring's hole.
  const IndexedMesh ring = test::body_of_depth([](const Vector3& p) {
    const double tube = 0.35 - std::hypot(std::hypot(p.x(), p.z()) - 0.75, p.y());
    return std::max(tube, test::bridge(p - Vector3(0.05, 0.0, 0.0)) - 0.03);
  });
  ASSERT_EQ(counted_genus(ring), 2);
  const HandleFreeMesh result = remove_handles(ring, {}, Execution(1));
  EXPECT_EQ(counted_genus(result.mesh), 1);
  EXPECT_EQ(result.report.cut.size(), 1U);
  EXPECT_EQ(result.report.kept, 1);
  EXPECT_GT(result.report.next.length, result.report.cut[0].length);
}

TEST(Handles, LeavesASphereAsItIs) {
  const IndexedMesh mesh = test::lumpy(3);
  const HandleFreeMesh result = remove_handles(mesh, {}, Execution(1));
  EXPECT_EQ(result.mesh.points, mesh.points);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  EXPECT_TRUE(result.report.cut.empty());
  EXPECT_EQ(result.report.volume_change, 0.0);
}

TEST(Handles, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::ball_with_a_bridge();
  const HandleFreeMesh one = remove_handles(mesh, {}, Execution(1));
  const HandleFreeMesh two = remove_handles(mesh, {}, Execution(2));
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
}

TEST(Handles, OfACheckedScanLeaveItsReportWithTheMeasuresOfWhatIsLeft) {
  // Faces of a handle that was wound the wrong way, and a point of no face: both counts stay.
  IndexedMesh scan = test::ball_with_a_bridge();
  for (std::size_t f = 0; f < 10; ++f) std::swap(scan.triangles[f][0], scan.triangles[f][1]);
  scan.points.emplace_back(9.0, 9.0, 9.0);
  const CheckedMesh before = check_mesh(scan, {}, Execution(1));
  ASSERT_EQ(before.report.genus, 1);
  CheckedMesh checked = before;
  const HandleReport report = cut_handles(checked, {}, Execution(1));

  const HandleFreeMesh free = remove_handles(before.mesh, {}, Execution(1));
  EXPECT_EQ(checked.mesh.points, free.mesh.points);
  EXPECT_EQ(checked.mesh.triangles, free.mesh.triangles);
  ASSERT_EQ(report.cut.size(), 1U);
  EXPECT_EQ(report.cut[0].place, free.report.cut[0].place);
  EXPECT_EQ(report.cut[0].length, free.report.cut[0].length);
  EXPECT_EQ(report.cut[0].edges, free.report.cut[0].edges);
  EXPECT_EQ(report.volume_change, free.report.volume_change);

  // Seen by itself what is left measures the same, but for the genus: that is what was scanned.
  const MeshCheckReport left = check_mesh(checked.mesh, {}, Execution(1)).report;
  EXPECT_EQ(left.genus, 0);
  EXPECT_EQ(checked.report.genus, 1);
  EXPECT_EQ(checked.report.vertices, left.vertices);
  EXPECT_EQ(checked.report.faces, left.faces);
  EXPECT_EQ(checked.report.sliver_faces, left.sliver_faces);
  EXPECT_EQ(checked.report.volume, left.volume);
  EXPECT_EQ(checked.report.area, left.area);
  EXPECT_EQ(checked.report.centroid, left.centroid);
  EXPECT_EQ(checked.report.equivalent_radius, left.equivalent_radius);
  EXPECT_NEAR(checked.report.volume / before.report.volume - 1.0, report.volume_change, 1e-12);
  EXPECT_NE(checked.report.volume, before.report.volume);
  EXPECT_NE(checked.report.area, before.report.area);
  EXPECT_EQ(checked.report.input_vertices, scan.points.size());
  EXPECT_EQ(checked.report.input_faces, scan.triangles.size());
  EXPECT_EQ(checked.report.reoriented_faces, 10U);
  EXPECT_EQ(checked.report.unreferenced_vertices, 1U);
}

TEST(Handles, OfACheckedScanWithoutAnyLeaveItAsItIs) {
  const CheckedMesh before = check_mesh(test::lumpy(3), {}, Execution(1));
  CheckedMesh checked = before;
  const HandleReport report = cut_handles(checked, {}, Execution(1));
  EXPECT_TRUE(report.cut.empty());
  EXPECT_EQ(report.volume_change, 0.0);
  EXPECT_EQ(checked.mesh.points, before.mesh.points);
  EXPECT_EQ(checked.mesh.triangles, before.mesh.triangles);
  EXPECT_EQ(checked.report.volume, before.report.volume);
  EXPECT_EQ(checked.report.genus, 0);
}

TEST(Handles, RefusesWhatItCannotUse) {
  IndexedMesh open = test::sphere(1);
  open.triangles.pop_back();
  EXPECT_ERROR(remove_handles(open, {}, Execution(1)), InvalidInput);
  EXPECT_ERROR(remove_handles(IndexedMesh{}, {}, Execution(1)), InvalidInput);
  HandleOptions options;
  options.length_limit = -1.0;
  EXPECT_ERROR(remove_handles(test::sphere(1), options, Execution(1)), InvalidInput);
  CheckedMesh checked = check_mesh(test::sphere(1), {}, Execution(1));
  EXPECT_ERROR(cut_handles(checked, options, Execution(1)), InvalidInput);
}

TEST(Handles, StopsWhenAskedTo) {
  // Before each cut, at the end, and three times while the surface is searched from the first root:
  // one search of a million vertices takes half a second.
  const IndexedMesh mesh = test::ball_with_a_bridge();
  test::expect_to_be_stopped(
      [&](const Execution& execution) { remove_handles(mesh, {}, execution); }, "Cutting handles",
      2 + 3 + 1);
}

}  // namespace
}  // namespace wscvt
