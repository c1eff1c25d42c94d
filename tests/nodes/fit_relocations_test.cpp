// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/fit_bodies.h"
#include "wscvt/nodes/fit_steps.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

/// A ball with fine waves about its north pole only, and nodes that are even all over it.
IndexedMesh half_wavy() {
  IndexedMesh ball = test::sphere(5);
  for (Vector3& p : ball.points) {
    const double within = std::max(0.0, p.z() - 0.5);
    p *= 1.0 + 0.3 * within * std::sin(14.0 * p.x()) * std::sin(13.0 * p.y());
  }
  return ball;
}

FitState wavy_state(double price = 0.0) {
  FitState state = test::fit_state(half_wavy(), test::clusters(half_wavy(), 300));
  state.round.evenness = 0.05;
  state.round.price = price;
  return state;
}

std::ptrdiff_t northern(const FitState& state) {
  return std::count_if(state.mesh.points.begin(), state.mesh.points.end(),
                       [](const Vector3& p) { return p.z() > 0.5; });
}

TEST(FitRelocations, BringNodesFromWhereTheyGainLittleToWhereTheyGainMuch) {
  FitState state = wavy_state();
  const double before = test::mean_square(state);
  const std::ptrdiff_t north = northern(state);
  const int moved = relocate_nodes(state, Execution(1));
  EXPECT_GT(moved, 5);
  EXPECT_LE(moved, 18);  // six in a hundred
  EXPECT_EQ(state.mesh.points.size(), 300u);
  EXPECT_EQ(state.mesh.triangles.size(), 596u);
  EXPECT_GE(northern(state), north + moved - 3);
  EXPECT_LT(test::mean_square(state), 0.95 * before);
  test::expect_in_step(state);
  EXPECT_TRUE(self_intersections({state.mesh.points, state.mesh.triangles}).empty());
}

TEST(FitRelocations, GainMoreThanTheyCostEachTime) {
  FitState state = wavy_state();
  const double first = test::mean_square(state);
  double last = first;
  int moved = 1;
  for (int round = 0; round < 60 && moved > 0; ++round) {
    moved = relocate_nodes(state, Execution(1));
    // What they gain and cost has springs too: once little is left, these may decide.
    EXPECT_LE(test::mean_square(state), 1.01 * last);
    last = test::mean_square(state);
  }
  EXPECT_LT(last, 0.9 * first);
  EXPECT_LE(moved, 1);  // nearly at rest
}

TEST(FitRelocations, LeaveAnEvenBall) {
  const IndexedMesh ball = test::sphere(4);
  FitState state = test::fit_state(ball, test::editable(test::sphere(2)));
  EXPECT_EQ(relocate_nodes(state, Execution(1)), 0);
}

TEST(FitRelocations, MakeNoSharpTriangle) {
  FitState state = wavy_state();
  relocate_nodes(state, Execution(1));
  // Relocations keep the angle of the early rounds in what they make.
  const double sharpest = std::max(state.round.early_sharpness, 0.0);
  const EditMesh start = wavy_state().mesh;
  double before = 0.0;
  for (std::size_t t = 0; t < start.triangles.size(); ++t) {
    before = std::max(before, start.sharpness(t));
  }
  for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
    EXPECT_LE(state.mesh.sharpness(t), std::max(before, sharpest) + 1e-12);
  }
  for (const std::int32_t degree : state.mesh.degrees) EXPECT_LE(degree, 10);
}

TEST(FitRelocations, KeepTheSpacingOfNodesWithThem) {
  FitState state = wavy_state();
  for (FitSample& sample : state.samples) sample.spacing = sample.point.z() > 0.0 ? 0.8 : 1.2;
  state.read_spacing();
  state.ring_edges.assign(300, state.edge);
  const std::vector<Vector3> before = state.mesh.points;
  ASSERT_GT(relocate_nodes(state, Execution(1)), 0);
  for (std::size_t i = 0; i < 300; ++i) {
    if (state.mesh.points[i] == before[i]) continue;
    const double z = state.mesh.points[i].z();
    if (std::abs(z) < 0.3) continue;
    EXPECT_NEAR(state.spacing[i], z > 0.0 ? 0.8 : 1.2, 0.1);
    EXPECT_LT(state.ring_edges[i], 0.8 * state.edge);
  }
}

TEST(FitRelocations, AreTheSameOnAnyNumberOfThreads) {
  FitState one = wavy_state();
  FitState three = one;
  EXPECT_EQ(relocate_nodes(one, Execution(1)), relocate_nodes(three, Execution(3)));
  EXPECT_EQ(one.mesh.points, three.mesh.points);
  EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
}

}  // namespace
}  // namespace wscvt
