// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_samples.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/test_shapes.h"
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
  const std::vector<Vector3> samples = visible_samples(surface, 100, Execution(1));
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
  const std::vector<Vector3> samples = visible_samples(surface, triangles, Execution(1));
  for (const SampleList& list : samples_of_triangles(nodes, triangulation, samples, Execution(1))) {
    ASSERT_GE(list.size(), 3U);
  }
}

TEST(RefinementSamples, StandInTheTriangleTheyAreSeenThrough) {
  const MeshSurface surface = surface_of(test::lumpy(3));
  const std::vector<Vector3> nodes = fibonacci_lattice(300);
  const SphereTriangulation triangulation(nodes);
  const std::vector<Vector3> samples = visible_samples(surface, 596, Execution(1));
  const std::vector<SampleList> lists =
      samples_of_triangles(nodes, triangulation, samples, Execution(1));
  EXPECT_EQ(lists, samples_of_triangles(nodes, triangulation, samples, Execution(3)));
  ASSERT_EQ(lists.size(), 596U);
  std::vector<int> uses(samples.size(), 0);
  for (std::size_t t = 0; t < lists.size(); ++t) {
    const Triangle& corners = triangulation.triangles()[t];
    for (const std::int32_t s : lists[t]) {
      ++uses[s];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3 side = nodes[corners[k]].cross(nodes[corners[(k + 1) % 3]]);
        ASSERT_GE(side.dot(samples[s]), 0.0);
      }
    }
  }
  for (const int count : uses) ASSERT_EQ(count, 1);
}

}  // namespace
}  // namespace wscvt
