// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/node_refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/mesh.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/measures/shape_descriptors.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

RefinementOptions rounds(int count) {
  RefinementOptions options;
  options.rounds = count;
  return options;
}

struct Case {
  std::vector<Vector3> positions;
  SphereTriangulation triangulation;
  MeshSurface original;
  IndexedMesh mesh() const { return {positions, triangulation.triangles()}; }
};

/// A lattice of `count` nodes on the surface of a body.
Case on_surface(const IndexedMesh& body, int count) {
  std::vector<Vector3> positions = fibonacci_lattice(count);
  SphereTriangulation triangulation(positions);
  MeshSurface original(body, Vector3::Zero(), 1.0, Execution(1));
  for (Vector3& p : positions) p *= original.radius(p);
  return {std::move(positions), std::move(triangulation), std::move(original)};
}

RefinedNodes refine(const Case& start, const RefinementOptions& options, int threads = 1) {
  return refine_nodes(start.positions, start.triangulation, start.original, options,
                      Execution(threads));
}

IndexedMesh mesh_of(const RefinedNodes& nodes) {
  return {nodes.positions, nodes.triangulation.triangles()};
}

double rms(const IndexedMesh& mesh, const IndexedMesh& reference) {
  return measure_distances(mesh, reference, {30000}, Execution(1)).root_mean_square;
}

void expect_promises(const RefinedNodes& nodes, std::size_t count) {
  ASSERT_EQ(nodes.positions.size(), count);
  ASSERT_EQ(nodes.triangulation.triangles().size(), 2 * count - 4);
  // Throws unless the faces fit an oriented 2-manifold; with the counts: closed, of genus 0.
  const Mesh mesh = to_mesh(mesh_of(nodes));
  EXPECT_EQ(mesh.n_edges(), 3 * count - 6);
  for (const auto edge : mesh.edges()) EXPECT_FALSE(mesh.is_boundary(edge));
  for (const Triangle& t : nodes.triangulation.triangles()) {
    EXPECT_GT(nodes.positions[t[0]].dot(nodes.positions[t[1]].cross(nodes.positions[t[2]])), 0.0);
  }
}

/// The half-edges agree with the triangles, so that the triangulation can be worked on further.
void expect_linked(const SphereTriangulation& triangulation) {
  const auto count = static_cast<std::int32_t>(triangulation.opposite().size());
  for (std::int32_t h = 0; h < count; ++h) {
    const std::int32_t other = triangulation.opposite()[h];
    EXPECT_EQ(triangulation.opposite()[other], h);
    EXPECT_EQ(triangulation.origin(other), triangulation.origin(SphereTriangulation::next(h)));
  }
  for (std::size_t v = 0; v < triangulation.vertex_count(); ++v) {
    EXPECT_EQ(triangulation.origin(triangulation.first_half_edge()[v]),
              static_cast<std::int32_t>(v));
  }
}

TEST(NodeRefinement, ZeroRoundsChangeNothing) {
  const Case start = on_surface(test::lumpy(3), 100);
  const RefinedNodes refined = refine(start, rounds(0));
  EXPECT_EQ(refined.positions, start.positions);
  EXPECT_EQ(refined.triangulation.triangles(), start.triangulation.triangles());
  EXPECT_TRUE(refined.report.history.empty());
}

TEST(NodeRefinement, KeepsItsPromisesAndComesNearer) {
  for (const double angle : {0.0, 15.5, 25.0}) {
    SCOPED_TRACE(angle);
    const IndexedMesh body = test::lumpy(4);
    const Case start = on_surface(body, 200);
    RefinementOptions options = rounds(12);
    options.smallest_angle = angle;
    const RefinedNodes refined = refine(start, options);
    expect_promises(refined, 200);
    expect_linked(refined.triangulation);
    const double allowed = std::min(angle, measure_quality(start.mesh()).smallest_angle);
    // Angles come from cosines: rounding near 15 degrees is below 1e-12 degrees.
    EXPECT_GE(measure_quality(mesh_of(refined)).smallest_angle, allowed - 1e-9);
    // Nodes on the surface are all chords; half of the distance goes with the first moves.
    EXPECT_LT(rms(mesh_of(refined), body), 0.5 * rms(start.mesh(), body));
    EXPECT_LT(refined.report.history.back().distance, 0.5 * refined.report.start_distance);
  }
}

TEST(NodeRefinement, MendsTheAnglesOfABadStart) {
  const IndexedMesh body = test::lumpy(4);
  Case start = on_surface(body, 200);
  std::vector<Vector3> directions = random_directions(200, test::announced(5));
  start.triangulation = SphereTriangulation(directions);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    start.positions[i] = start.original.radius(directions[i]) * directions[i];
  }
  ASSERT_LT(measure_quality(start.mesh()).smallest_angle, 5.0);
  const RefinedNodes refined = refine(start, rounds(20));
  expect_promises(refined, 200);
  EXPECT_GE(measure_quality(mesh_of(refined)).smallest_angle, 15.5 - 1e-9);
}

TEST(NodeRefinement, ReportsTheDistanceThatIsThere) {
  const IndexedMesh body = test::lumpy(4);
  const RefinedNodes refined = refine(on_surface(body, 200), rounds(5));
  // Distances to planes from points of the original against two-sided distances to triangles.
  EXPECT_NEAR(refined.report.history.back().distance / rms(mesh_of(refined), body), 1.0, 0.1);
}

TEST(NodeRefinement, SlidesNodesOnToTheEdgesOfABox) {
  // Only nodes on its edges let a mesh follow a box; on the surface alone the corners are cut.
  const IndexedMesh body = test::subdivided(test::box(1.0, 1.2, 1.4), 4);
  const Case start = on_surface(body, 150);
  RefinementOptions options = rounds(60);
  const RefinedNodes refined = refine(start, options);
  expect_promises(refined, 150);
  EXPECT_LT(rms(mesh_of(refined), body), 0.15 * rms(start.mesh(), body));
  int relocations = 0;
  for (const RefinementStep& step : refined.report.history) relocations += step.relocations;
  EXPECT_GT(relocations, 0);
}

TEST(NodeRefinement, ASphereStaysASphere) {
  const RefinedNodes refined = refine(on_surface(test::sphere(5), 300), rounds(20));
  expect_promises(refined, 300);
  double smallest = 2.0;
  double largest = 0.0;
  for (const Vector3& p : refined.positions) {
    smallest = std::min(smallest, p.norm());
    largest = std::max(largest, p.norm());
  }
  // Above the sphere, by less than twice the sagitta of an edge of 0.22, which is 0.006.
  EXPECT_GT(smallest, 1.0);
  EXPECT_LT(largest, 1.012);
}

TEST(NodeRefinement, FollowsScaleAndRotation) {
  const IndexedMesh body = test::lumpy(3);
  const Case start = on_surface(body, 120);
  // A power of two scales without rounding, so every decision is the same.
  const double factor = 1024.0;
  Case scaled{start.positions, start.triangulation,
              MeshSurface(test::scaled(body, Vector3(factor, factor, factor)), Vector3::Zero(), 1.0,
                          Execution(1))};
  for (Vector3& p : scaled.positions) p *= factor;
  const RefinedNodes plain = refine(start, rounds(8));
  const RefinedNodes large = refine(scaled, rounds(8));
  EXPECT_EQ(plain.triangulation.triangles(), large.triangulation.triangles());
  for (std::size_t i = 0; i < plain.positions.size(); ++i) {
    EXPECT_NEAR((large.positions[i] / factor - plain.positions[i]).norm(), 0.0, 1e-9);
  }
  // A rotation rounds, and what hangs on a comparison may come out otherwise: the distance holds.
  const Eigen::Matrix3d rotation = test::random_rotation(test::announced(3));
  const IndexedMesh turned_body = test::transformed(body, rotation);
  Case turned{start.positions, start.triangulation,
              MeshSurface(turned_body, Vector3::Zero(), 1.0, Execution(1))};
  for (Vector3& p : turned.positions) p = rotation * p;
  const double turned_rms = rms(mesh_of(refine(turned, rounds(8))), turned_body);
  EXPECT_NEAR(turned_rms / rms(mesh_of(plain), body), 1.0, 0.05);
}

TEST(NodeRefinement, SameBytesOnAnyNumberOfThreads) {
  const Case start = on_surface(test::lumpy(4), 250);
  const RefinedNodes one = refine(start, rounds(6), 1);
  const RefinedNodes three = refine(start, rounds(6), 3);
  EXPECT_EQ(one.positions, three.positions);
  EXPECT_EQ(one.triangulation.triangles(), three.triangulation.triangles());
}

TEST(NodeRefinement, WorksOnTheFewestNodes) {
  for (const int count : {4, 5, 6, 8}) {
    SCOPED_TRACE(count);
    const IndexedMesh body = test::lumpy(3);
    const Case start = on_surface(body, count);
    const RefinedNodes refined = refine(start, rounds(20));
    expect_promises(refined, static_cast<std::size_t>(count));
    EXPECT_LT(refined.report.history.back().distance, refined.report.start_distance);
  }
}

TEST(NodeRefinement, StopsWhenThereIsNothingToGain) {
  // The original's own vertices: no error at all.
  const IndexedMesh body = test::lumpy(2);
  Case start = on_surface(body, 50);
  start.positions = body.points;
  std::vector<Vector3> directions = body.points;
  for (Vector3& p : directions) p.normalize();
  start.triangulation = SphereTriangulation(directions);
  start.triangulation.restore_surface_delaunay(directions, body.points, Execution(1));
  const RefinedNodes refined = refine(start, rounds(50));
  EXPECT_LT(refined.report.history.size(), 50U);
  EXPECT_TRUE(refined.report.converged);
  expect_promises(refined, body.points.size());
}

TEST(NodeRefinement, RefusesOptionsOutOfRange) {
  const Case start = on_surface(test::lumpy(2), 50);
  RefinementOptions options = rounds(-1);
  EXPECT_THROW(refine(start, options), Error);
  options = rounds(1);
  options.smallest_angle = 50.0;
  EXPECT_THROW(refine(start, options), Error);
  options = rounds(1);
  options.tolerance = 1.0;
  EXPECT_THROW(refine(start, options), Error);
}

TEST(NodeRefinement, CanBeCancelledWithinARound) {
  const Case start = on_surface(test::lumpy(2), 50);
  int reports = 0;
  const Execution execution(1, [&](double fraction, const std::string&) {
    EXPECT_LT(fraction, 1.0);
    return ++reports < 3;
  });
  EXPECT_THROW(
      refine_nodes(start.positions, start.triangulation, start.original, rounds(1), execution),
      Error);
  EXPECT_EQ(reports, 3);
}

TEST(NodeRefinement, CanBeCancelled) {
  const Case start = on_surface(test::lumpy(2), 50);
  const Execution execution(1, [](double, const std::string&) { return false; });
  try {
    refine_nodes(start.positions, start.triangulation, start.original, rounds(3), execution);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

}  // namespace
}  // namespace wscvt
