// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/step_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

std::vector<Vector3> random_steps(std::size_t count, double length) {
  std::mt19937_64 engine(test::announced(3));
  std::normal_distribution<double> shift(0.0, length);
  std::vector<Vector3> steps;
  for (std::size_t i = 0; i < count; ++i) {
    steps.emplace_back(shift(engine), shift(engine), shift(engine));
  }
  return steps;
}

TEST(GuardedSteps, TakeAllOfStepsThatNoLimitForbids) {
  const IndexedMesh mesh = test::sphere(2);
  const HalfEdges half_edges = link_half_edges(mesh.triangles, mesh.points.size());
  const std::vector<Vector3> steps = random_steps(mesh.points.size(), 1e-3);
  GuardedSteps guarded(mesh, half_edges, steps, {30.0, 90.0}, Execution(1));
  const std::vector<Vector3> positions = guarded.positions();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(positions[i], Vector3(mesh.points[i] + steps[i]));
  }
  EXPECT_EQ(guarded.held_back(), 0);
}

TEST(GuardedSteps, KeepAnglesAndTurnsWithinTheLimits) {
  // Edges of 0.3 and steps as long: turned over, if it were not for the limits.
  const IndexedMesh mesh = test::sphere(2);
  const HalfEdges half_edges = link_half_edges(mesh.triangles, mesh.points.size());
  const Execution execution(1);
  const StepLimits limits{40.0, 50.0};
  GuardedSteps guarded(mesh, half_edges, random_steps(mesh.points.size(), 0.15), limits, execution);
  const IndexedMesh after{guarded.positions(), mesh.triangles};
  EXPECT_GT(guarded.held_back(), 80);
  std::vector<Vector3> normals;
  for (const auto& [a, b, c] : after.triangles) {
    EXPECT_LE(largest_corner_cosine(after.points[a], after.points[b], after.points[c]),
              std::cos(limits.smallest_angle * test::pi / 180.0));
    normals.push_back(
        doubled_area_normal(after.points[a], after.points[b], after.points[c]).normalized());
  }
  for (std::size_t h = 0; h < half_edges.opposite.size(); ++h) {
    EXPECT_GE(normals[h / 3].dot(normals[half_edges.opposite[h] / 3]),
              std::cos(limits.largest_turn * test::pi / 180.0));
  }
}

TEST(GuardedSteps, LookAtAnglesWhereNothingTurns) {
  // A node in the middle of a box's face slides within it.
  const IndexedMesh mesh = test::subdivided(test::box(1.0, 1.0, 1.0), 2);
  const HalfEdges half_edges = link_half_edges(mesh.triangles, mesh.points.size());
  const Execution execution(1);
  std::vector<Vector3> steps(mesh.points.size(), Vector3::Zero());
  const double top =
      std::max_element(mesh.points.begin(), mesh.points.end(),
                       [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); })
          ->z();
  Vector3 middle = Vector3::Zero();
  int corners = 0;
  for (const Vector3& p : mesh.points) {
    if (p.z() == top) {
      middle += p;
      ++corners;
    }
  }
  middle /= corners;
  std::size_t node = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if ((mesh.points[i] - middle).norm() < 1e-12) node = i;
  }
  ASSERT_LT((mesh.points[node] - middle).norm(), 1e-12);
  steps[node] = Vector3(0.1875, 0.0, 0.0);
  const auto sharpest = [&](const StepLimits& limits) {
    const std::vector<Vector3> moved =
        GuardedSteps(mesh, half_edges, steps, limits, execution).positions();
    double cosine = -1.0;
    for (const auto& [a, b, c] : mesh.triangles) {
      cosine = std::max(cosine, largest_corner_cosine(moved[a], moved[b], moved[c]));
    }
    return std::acos(cosine) * 180.0 / test::pi;
  };
  EXPECT_LT(sharpest({0.0, 91.0}), 30.0);
  EXPECT_GE(sharpest({40.0, 91.0}), 40.0);
}

TEST(GuardedSteps, HoldBackByHalvesAndAtLastAltogether) {
  const IndexedMesh mesh = test::sphere(1);
  const HalfEdges half_edges = link_half_edges(mesh.triangles, mesh.points.size());
  const Execution execution(1);
  std::vector<Vector3> steps(mesh.points.size(), Vector3::Zero());
  steps[4] = Vector3(1e-3, 0.0, 0.0);
  GuardedSteps guarded(mesh, half_edges, steps, StepLimits(), execution);
  double share = 1.0;
  for (int halvings = 0; halvings < 5; ++halvings, share *= 0.5) {
    EXPECT_EQ(guarded.positions()[4], Vector3(mesh.points[4] + share * steps[4]));
    EXPECT_TRUE(guarded.hold_back(4));
  }
  EXPECT_EQ(guarded.positions()[4], mesh.points[4]);
  EXPECT_FALSE(guarded.hold_back(4));
  EXPECT_EQ(guarded.held_back(), 1);
}

}  // namespace
}  // namespace wscvt
