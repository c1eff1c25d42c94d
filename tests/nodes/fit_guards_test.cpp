// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/fit_bodies.h"
#include "wscvt/nodes/fit_steps.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

std::vector<Vector3> still(const FitState& state) {
  return std::vector<Vector3>(state.mesh.points.size(), Vector3::Zero());
}

TEST(FitGuards, LetShortStepsPassAndShortenLongOnes) {
  const IndexedMesh ball = test::sphere(3);
  FitState state = test::fit_state(ball, test::editable(test::sphere(2)));
  const std::vector<Vector3> before = state.mesh.points;
  std::vector<Vector3> step = still(state);
  const Vector3 tangent = before[7].unitOrthogonal();
  step[7] = 0.1 * state.edge * tangent;
  step[100] = state.edge * before[100];
  move_nodes(state, step, Execution(1));
  EXPECT_LT((state.mesh.points[7] - before[7] - step[7]).norm(), 1e-15);
  const double moved = (state.mesh.points[100] - before[100]).norm();
  EXPECT_LE(moved, 0.35 * state.edge + 1e-12);
  EXPECT_GT(moved, 0.05 * state.edge);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i == 7 || i == 100) continue;
    EXPECT_EQ(state.mesh.points[i], before[i]);
  }
}

TEST(FitGuards, TurnNoTriangleFar) {
  const IndexedMesh ball = test::sphere(3);
  FitState state = test::fit_state(ball, test::editable(test::sphere(2)));
  std::vector<Vector3> normals;
  for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
    normals.push_back(state.unit_normal(t));
  }
  // Every node wants to go its own way, past its neighbours.
  std::vector<Vector3> step = still(state);
  for (std::size_t i = 0; i < step.size(); ++i) {
    const double at = static_cast<double>(i);
    step[i] =
        2.0 * state.edge * Vector3(std::sin(7.0 * at), std::cos(5.0 * at), std::sin(11.0 * at));
  }
  const std::vector<Vector3> before = state.mesh.points;
  move_nodes(state, step, Execution(1));
  double moved = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    moved += (state.mesh.points[i] - before[i]).norm() / static_cast<double>(before.size());
  }
  EXPECT_GT(moved, 0.02 * state.edge);
  for (std::size_t t = 0; t < normals.size(); ++t) {
    // 72 degrees, and no more than 78 against the scan.
    EXPECT_GE(state.unit_normal(t).dot(normals[t]), 0.3 - 1e-9);
    EXPECT_GE(state.unit_normal(t).dot(state.sample_normals[t].normalized()), 0.2 - 1e-9);
    EXPECT_LE(state.mesh.sharpness(t), state.round.sharpness_limit + 1e-8);
  }
}

TEST(FitGuards, LetNoTriangleTurnAwayFromTheScanStepByStep) {
  const IndexedMesh ball = test::sphere(3);
  FitState state = test::fit_state(ball, test::editable(test::sphere(2)));
  state.round.sharpness_limit = 1.0;
  const std::vector<Vector3> outward = state.sample_normals;
  std::vector<Vector3> step = still(state);
  step[40] = 0.3 * state.edge * state.mesh.points[40];
  const double start = state.mesh.points[40].norm();
  for (int i = 0; i < 120; ++i) move_nodes(state, step, Execution(1));
  EXPECT_GT(state.mesh.points[40].norm(), start + state.edge);
  for (std::size_t t = 0; t < outward.size(); ++t) {
    EXPECT_GE(state.unit_normal(t).dot(outward[t].normalized()), 0.2 - 1e-9);
  }
}

TEST(FitGuards, KeepTheAngleOfLateRounds) {
  const IndexedMesh ball = test::sphere(3);
  FitState state = test::fit_state(ball, test::editable(test::sphere(2)));
  state.round.late = true;
  state.round.sharpness_limit = std::cos(40.0 * pi / 180.0);
  std::vector<Vector3> step = still(state);
  const std::int32_t v = 20;
  const std::int32_t w = state.mesh.target(state.mesh.first[v]);
  step[v] = 0.34 * (state.mesh.points[w] - state.mesh.points[v]);
  step[w] = -step[v];
  move_nodes(state, step, Execution(1));
  EXPECT_GE(test::smallest_angle(state.mesh), 40.0 - 1e-6);
}

TEST(FitGuards, DriveNothingThroughTheOtherSheet) {
  const IndexedMesh plate = test::subdivided(test::box(2.0, 1.8, 0.1), 4);
  FitState state = test::fit_state(plate, test::clusters(plate, 300));
  ASSERT_TRUE(self_intersections({state.mesh.points, state.mesh.triangles}).empty());
  std::vector<Vector3> step = still(state);
  for (std::size_t i = 0; i < step.size(); ++i) {
    // The upper sheet down in the middle, as far as steps go: .05, of a thickness of .1; the lower
    // one up.
    const Vector3& p = state.mesh.points[i];
    if (p.head<2>().norm() < 0.6) step[i].z() = p.z() > 0.0 ? -1.0 : 1.0;
  }
  const std::vector<Vector3> before = state.mesh.points;
  move_nodes(state, step, Execution(1));
  EXPECT_NE(state.mesh.points, before);
  EXPECT_TRUE(self_intersections({state.mesh.points, state.mesh.triangles}).empty());
}

TEST(FitGuards, AreTheSameOnAnyNumberOfThreads) {
  const IndexedMesh body = test::lumpy(4);
  FitState one = test::fit_state(body, test::clusters(body, 1300), 1.1, 8);
  FitState three = one;
  std::vector<Vector3> step;
  for (const Vector3& p : one.mesh.points) step.push_back(p.unitOrthogonal());
  move_nodes(one, step, Execution(1));
  move_nodes(three, step, Execution(3));
  EXPECT_EQ(one.mesh.points, three.mesh.points);
}

}  // namespace
}  // namespace wscvt
