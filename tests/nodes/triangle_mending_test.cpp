// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/triangle_mending.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/nodes/self_intersections.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/mapped_surface.h"

namespace wscvt {
namespace {

/// A scan over the sphere and nodes on it.
struct Jammed {
  MappedSurface surface;
  std::vector<MeshPlace> places;
  IndexedMesh nodes;
};

/// A lumpy body with 400 even nodes.
Jammed even_nodes() {
  const IndexedMesh sphere = test::sphere(5);
  Jammed result{MappedSurface(test::lumpy(5), sphere.points, Execution(1)), {}, {}};
  const std::vector<Vector3> seeds = fibonacci_lattice(400);
  const SphereTriangulation triangulation(seeds);
  for (const Vector3& u : seeds) {
    result.places.push_back(result.surface.locate(u));
    result.nodes.points.push_back(result.surface.position(result.places.back()));
  }
  result.nodes.triangles = triangulation.triangles();
  return result;
}

/// Long thin triangles: some nodes lie all but in the middle of an edge.
Jammed slivered() {
  Jammed result = even_nodes();
  const std::vector<Triangle> triangles = result.nodes.triangles;
  std::vector<char> used(result.nodes.points.size(), 0);
  for (std::size_t f = 0; f < triangles.size(); f += 200) {
    const auto [a, b, c] = triangles[f];
    if (used[a] + used[b] + used[c] > 0) continue;
    used[a] = used[b] = used[c] = 1;
    const Vector3 wanted = 0.5 * (result.nodes.points[a] + result.nodes.points[b]) +
                           0.04 * (result.nodes.points[c] - result.nodes.points[a]);
    result.places[c] = result.surface.locate(wanted);
    result.nodes.points[c] = result.surface.position(result.places[c]);
  }
  return result;
}

void expect_closed(const IndexedMesh& mesh, std::size_t nodes) {
  ASSERT_EQ(mesh.points.size(), nodes);
  ASSERT_EQ(mesh.triangles.size(), 2 * nodes - 4);
  const MeshCheckReport report = check_mesh(mesh, MeshCheckOptions(), Execution(1)).report;
  EXPECT_EQ(report.vertices, nodes);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.reoriented_faces, 0U);
}

TEST(TriangleMending, LeavesGoodTrianglesAlone) {
  const Jammed even = even_nodes();
  TriangleMendingOptions options;
  options.smallest_angle = measure_quality(even.nodes).smallest_angle - 1e-6;
  const MendedTriangles mended =
      mend_triangles(even.nodes, even.places, even.surface, options, Execution(1));
  EXPECT_EQ(mended.mesh.points, even.nodes.points);
  EXPECT_EQ(mended.mesh.triangles, even.nodes.triangles);
  EXPECT_EQ(mended.report.left, 0);
  EXPECT_TRUE(mended.relocated.empty());
}

TEST(TriangleMending, FreesSliversOnTheScan) {
  const Jammed bad = slivered();
  ASSERT_LT(measure_quality(bad.nodes).smallest_angle, 12.0);
  const MendedTriangles mended =
      mend_triangles(bad.nodes, bad.places, bad.surface, {}, Execution(1));
  expect_closed(mended.mesh, 400);
  EXPECT_EQ(mended.report.left, 0);
  EXPECT_GE(measure_quality(mended.mesh).smallest_angle, TriangleMendingOptions().smallest_angle);
  EXPECT_TRUE(self_intersections(mended.mesh).empty());
  const MeshDistance scan(bad.surface.mesh());
  for (const Vector3& p : mended.mesh.points) EXPECT_LT(scan.distance(p), 1e-12);
  // Only what lies about a sliver moves.
  std::size_t same = 0;
  for (std::size_t i = 0; i < 400; ++i) same += mended.mesh.points[i] == bad.nodes.points[i];
  EXPECT_GT(same, 200U);
}

TEST(TriangleMending, TakesNodesFromWhereTheyCrowd) {
  // Eight nodes within one triangle, each put into the last: moves cannot make room for them.
  Jammed crowd = even_nodes();
  constexpr int extra = 8;
  for (int k = 0; k < extra; ++k) {
    const auto [a, b, c] = crowd.nodes.triangles.front();
    const auto v = static_cast<std::int32_t>(crowd.nodes.points.size());
    const std::vector<Vector3>& points = crowd.nodes.points;
    crowd.places.push_back(crowd.surface.locate(points[a] + points[b] + points[c]));
    crowd.nodes.points.push_back(crowd.surface.position(crowd.places.back()));
    crowd.nodes.triangles.front() = {b, c, v};
    crowd.nodes.triangles.push_back({a, b, v});
    crowd.nodes.triangles.push_back({c, a, v});
  }
  const MendedTriangles mended =
      mend_triangles(crowd.nodes, crowd.places, crowd.surface, {}, Execution(1));
  expect_closed(mended.mesh, 400 + extra);
  EXPECT_EQ(mended.report.left, 0);
  EXPECT_GT(mended.report.relocations, 0);
  EXPECT_FALSE(mended.relocated.empty());
  const std::set<std::int32_t> once(mended.relocated.begin(), mended.relocated.end());
  EXPECT_EQ(once.size(), mended.relocated.size());
  EXPECT_TRUE(std::is_sorted(mended.relocated.begin(), mended.relocated.end()));
}

TEST(TriangleMending, RefusesOptionsOutOfRange) {
  const Jammed even = even_nodes();
  const auto mend = [&](TriangleMendingOptions options, std::size_t places) {
    mend_triangles(even.nodes, {even.places.begin(), even.places.begin() + places}, even.surface,
                   options, Execution(1));
  };
  TriangleMendingOptions wide;
  wide.smallest_angle = 60.0;
  EXPECT_ERROR(mend(wide, 400), InvalidInput);
  TriangleMendingOptions turned;
  turned.largest_turn = 0.0;
  EXPECT_ERROR(mend(turned, 400), InvalidInput);
  TriangleMendingOptions rounds;
  rounds.rounds = -1;
  EXPECT_ERROR(mend(rounds, 400), InvalidInput);
  EXPECT_ERROR(mend({}, 399), InvalidInput);
}

}  // namespace
}  // namespace wscvt
