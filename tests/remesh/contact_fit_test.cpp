// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/contact_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

/// Mean and rms over random directions of how far balls that touch the unit sphere from outside
/// are from the node nearest to them.
struct Gap {
  double mean = 0.0;
  double rms = 0.0;
};

Gap gap_on_unit_sphere(const std::vector<Vector3>& nodes, double ball_radius) {
  constexpr int count = 4000;
  Gap gap;
  for (int i = 0; i < count; ++i) {
    const Vector3 centre =
        (1.0 + ball_radius) * test::random_rotation(static_cast<std::uint64_t>(i)).col(0);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector3& p : nodes) nearest = std::min(nearest, (p - centre).norm());
    gap.mean += (nearest - ball_radius) / count;
    gap.rms += std::pow(nearest - ball_radius, 2) / count;
  }
  gap.rms = std::sqrt(gap.rms);
  return gap;
}

TEST(ContactFit, TakesTheMeanGapAwayAndHalvesTheRest) {
  const IndexedMesh nodes = test::sphere(2);  // 162 nodes on the surface
  const IndexedMesh grain = test::sphere(5);
  for (const double radius : {0.4, 1.3, 5.0}) {
    SCOPED_TRACE("radius " + std::to_string(radius));
    const Gap before = gap_on_unit_sphere(nodes.points, radius);
    const Gap after =
        gap_on_unit_sphere(fit_to_contacts(nodes, grain, radius, Execution(2)), radius);
    EXPECT_GT(before.mean, 0.004);
    EXPECT_LT(std::abs(after.mean), 0.05 * before.mean);
    EXPECT_LT(after.rms, 0.6 * before.rms);
  }
}

TEST(ContactFit, SmallerBallsTakeNodesFartherOut) {
  const IndexedMesh nodes = test::sphere(2);
  const IndexedMesh grain = test::sphere(5);
  double before = std::numeric_limits<double>::infinity();
  for (const double radius : {0.3, 1.0, 10.0}) {
    double reach = 0.0;
    for (const Vector3& p : fit_to_contacts(nodes, grain, radius, Execution(2))) {
      reach += p.norm() / static_cast<double>(nodes.points.size());
    }
    EXPECT_GT(reach, 1.0);
    EXPECT_LT(reach, before);
    before = reach;
  }
}

TEST(ContactFit, LeavesTheMeshWhole) {
  const IndexedMesh grain = test::sphere(5);
  // Nodes at random have slivers between them, which turn over at the least move.
  IndexedMesh nodes;
  nodes.points = random_directions(150, 3);
  nodes.triangles = SphereTriangulation(nodes.points).triangles();
  const std::vector<Vector3> start = nodes.points;
  nodes.points = fit_to_contacts(nodes, grain, 0.4, Execution(2));
  EXPECT_NE(nodes.points, start);
  EXPECT_TRUE(self_intersections(nodes).empty());
  for (const Triangle& t : nodes.triangles) {
    const Vector3 before = doubled_area_normal(start[t[0]], start[t[1]], start[t[2]]);
    const Vector3 after =
        doubled_area_normal(nodes.points[t[0]], nodes.points[t[1]], nodes.points[t[2]]);
    EXPECT_GE(before.dot(after), 0.34 * before.norm() * after.norm());
  }
}

TEST(ContactFit, NodesInAHollowThatNoBallReachesStay) {
  // A deep narrow dent about the pole: its bottom is out of reach.
  IndexedMesh grain = test::sphere(5);
  IndexedMesh nodes = test::sphere(3);
  for (IndexedMesh* mesh : {&grain, &nodes}) {
    for (Vector3& p : mesh->points) {
      const double off = p.head<2>().norm();
      if (p.z() > 0.0 && off < 0.3) p *= 0.5 + 0.5 * off / 0.3;
    }
  }
  const std::vector<Vector3> moved = fit_to_contacts(nodes, grain, 1.0, Execution(2));
  int in_the_dent = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Vector3& p = nodes.points[i];
    if (p.z() > 0.0 && p.head<2>().norm() < 0.12 && p.norm() < 0.8) {
      EXPECT_EQ(moved[i], p);
      ++in_the_dent;
    }
  }
  EXPECT_GT(in_the_dent, 3);
}

TEST(ContactFit, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh grain = test::lumpy(4);
  const IndexedMesh nodes = test::lumpy(2);
  EXPECT_EQ(fit_to_contacts(nodes, grain, 0.4, Execution(1)),
            fit_to_contacts(nodes, grain, 0.4, Execution(3)));
}

TEST(ContactFit, RefusesBallsWithoutASize) {
  const IndexedMesh nodes = test::sphere(2);
  for (const double radius : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_ERROR(fit_to_contacts(nodes, nodes, radius, Execution(1)), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
