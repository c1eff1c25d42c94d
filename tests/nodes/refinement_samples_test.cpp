// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_samples.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "support/test_shapes.h"
#include "wscvt/nodes/node_refinement.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

MeshSurface surface_of(const IndexedMesh& mesh) {
  return {mesh, Vector3::Zero(), 1.0, Execution(1)};
}

TEST(RefinementSamples, LeaveOutWhatLiesBehindTheOutermostSheet) {
  // A sphere of radius 0.3 within another: it holds one sample in twelve.
  const IndexedMesh outer = test::sphere(3);
  const IndexedMesh inner =
      test::transformed(outer, 0.3 * Matrix3::Identity(), Vector3(0.0, 0.0, 0.6));
  const MeshSurface surface = surface_of(test::joined(outer, inner));
  const std::vector<Vector3> samples = RadialTarget(surface).samples(100, Execution(1)).points;
  EXPECT_GT(samples.size(), 45000U);
  EXPECT_LT(samples.size(), 50000U);
  // The flat faces of the outer sphere come as near as 0.98, the inner sphere reaches 0.9.
  for (const Vector3& s : samples) ASSERT_GT(s.norm(), 0.95);
}

TEST(RefinementSamples, AreEnoughForThePlaneOfEveryTriangle) {
  // Three points make a plane.
  const MeshSurface surface = surface_of(test::sphere(4));
  const std::vector<Vector3> nodes = fibonacci_lattice(10000);
  const SphereTriangulation triangulation(nodes);
  const std::size_t triangles = triangulation.triangles().size();
  const RefinementSamples samples = RadialTarget(surface).samples(triangles, Execution(1));
  for (const SampleList& list :
       samples_of_triangles(radial_nodes(nodes), triangulation, samples, Execution(1))) {
    ASSERT_GE(list.size(), 3U);
  }
}

TEST(RefinementSamples, StandInTheTriangleTheyAreSeenThrough) {
  const MeshSurface surface = surface_of(test::lumpy(3));
  const std::vector<Vector3> nodes = fibonacci_lattice(300);
  const SphereTriangulation triangulation(nodes);
  const RefinementSamples samples = RadialTarget(surface).samples(596, Execution(1));
  const std::vector<SampleList> lists =
      samples_of_triangles(radial_nodes(nodes), triangulation, samples, Execution(1));
  EXPECT_EQ(lists, samples_of_triangles(radial_nodes(nodes), triangulation, samples, Execution(3)));
  ASSERT_EQ(lists.size(), 596U);
  std::vector<int> uses(samples.size(), 0);
  for (std::size_t t = 0; t < lists.size(); ++t) {
    const Triangle& corners = triangulation.triangles()[t];
    for (const std::int32_t s : lists[t]) {
      ++uses[s];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3 side = nodes[corners[k]].cross(nodes[corners[(k + 1) % 3]]);
        ASSERT_GE(side.dot(samples.points[s]), 0.0);
      }
    }
  }
  for (const int count : uses) ASSERT_EQ(count, 1);
}

// The normals are those of the scan where the samples lie, also where some were left out.
TEST(RefinementSamples, KnowTheNormalsOfTheScan) {
  const IndexedMesh outer = test::sphere(3);
  const MeshSurface surface = surface_of(test::joined(
      outer, test::transformed(outer, 0.3 * Matrix3::Identity(), Vector3(0.0, 0.0, 0.6))));
  const RefinementSamples samples = RadialTarget(surface).samples(100, Execution(1));
  ASSERT_EQ(samples.normals.size(), samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    // Faces of the sphere have edges of 0.17: their normals are within 0.1 of the radius'.
    ASSERT_GT(samples.normals[s].dot(samples.points[s].normalized().cast<float>()), 0.99F);
  }
}

TEST(RefinementTarget, NodesOverAMapLieWhereTheyAreNearest) {
  // Two sheets: the lower half of a sphere folded up into the upper, 0.2 below it.
  const IndexedMesh sphere = test::sphere(4);
  IndexedMesh bowl = sphere;
  for (Vector3& p : bowl.points) {
    if (p.z() < 0.0) p = (1.0 - 0.2 * std::min(1.0, -10.0 * p.z())) * Vector3(p.x(), p.y(), -p.z());
  }
  const MappedSurface surface(bowl, sphere.points, Execution(1));
  const MappedTarget target(surface, nullptr);
  const RefinementSamples samples = target.samples(100, Execution(2));
  ASSERT_EQ(samples.directions.size(), samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    ASSERT_LT((surface.position(samples.directions[s]) - samples.points[s]).norm(), 1e-9);
  }
  const Vector3 up = Vector3(0.3, 0.1, 0.9).normalized();
  const std::vector<RefinementNode> nodes =
      mapped_nodes({up, 0.8 * up}, {up, Vector3(up.x(), up.y(), -up.z())}, surface, Execution(1));
  // A tenth of the way to the other sheet and a bit aside.
  const Vector3 between = 0.9 * up + Vector3(0.02, 0.0, 0.0);
  Vector3 normal;
  for (const RefinementNode& node : nodes) {
    const RefinementNode moved = target.node_at(between, node);
    EXPECT_EQ(moved.position, between);
    // On the sheet it came from.
    EXPECT_GT(moved.direction.z() * node.direction.z(), 0.0);
    const double residual = target.residual(moved, normal);
    const bool is_outer = node.direction.z() > 0.0;
    // The outer sheet lies 0.1 outwards; the inner one 0.1 inwards, where its outside is.
    EXPECT_NEAR(residual, 0.1, 0.02);
    EXPECT_GT((is_outer ? 1.0 : -1.0) * normal.dot(up), 0.95);
  }
}

TEST(RefinementTarget, OfALevelIsTheScanItself) {
  const IndexedMesh level = test::sphere(2);
  const IndexedMesh scan = test::sphere(5);
  const MappedSurface surface(level, level.points, Execution(1));
  const MeshDistance to_scan(scan);
  const MappedTarget target(surface, &to_scan);
  const RefinementSamples samples = target.samples(100, Execution(2));
  for (std::size_t s = 0; s < samples.size(); s += 50) {
    // The middles of the level's faces lie 0.01 and more below the sphere.
    ASSERT_LT(to_scan.distance(samples.points[s]), 1e-12);
  }
  const Vector3 u = Vector3(1.0, 0.7, 0.4).normalized();
  Vector3 normal;
  const double residual =
      target.residual(mapped_nodes({0.9 * u}, {u}, surface, Execution(1)).front(), normal);
  EXPECT_NEAR(residual, 0.1, 2e-3);  // faces of the scan lie up to 4e-4 below the sphere
}

}  // namespace
}  // namespace wscvt
