// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/fit_bodies.h"
#include "wscvt/nodes/fit_steps.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

/// Nodes of a ball of which one stands off by a vector.
FitState with_one_off(std::int32_t v, const Vector3& by) {
  EditMesh nodes = test::editable(test::sphere(2));
  nodes.points[v] += by;
  return test::fit_state(test::sphere(4), nodes);
}

double rms(const FitState& state) { return std::sqrt(test::mean_square(state)); }

TEST(FitPolish, BringsBackANodeThatMakesSharpTriangles) {
  const EditMesh sound = test::editable(test::sphere(2));
  constexpr std::int32_t v = 30;
  const std::int32_t w = sound.target(sound.first[v]);
  FitState state = with_one_off(v, 0.7 * (sound.points[w] - sound.points[v]));
  state.round.price = 0.01;
  const double before = test::smallest_angle(state.mesh);
  ASSERT_LT(before, 25.0);
  const std::vector<Vector3> start = state.mesh.points;
  EXPECT_GT(polish_nodes(state, 5), 0);
  test::expect_in_step(state);
  EXPECT_GT(test::smallest_angle(state.mesh), before + 5.0);
  // Far from there nothing is sharp, and no node is asked.
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (start[i].dot(start[v]) >= 0.2) continue;
    EXPECT_EQ(state.mesh.points[i], start[i]);
  }
}

TEST(FitPolish, LeavesAMeshWithoutSharpTriangles) {
  FitState state = with_one_off(30, Vector3::Zero());
  EXPECT_EQ(polish_nodes(state, 3), 0);
}

TEST(FitPolish, GoesToFarSamplesInTheLateRounds) {
  // A cone's tip on the ball that no node has found.
  IndexedMesh scan = test::sphere(5);
  const Vector3 tip = test::sphere(2).points[50];
  for (Vector3& p : scan.points) {
    const double off = (p.normalized() - tip).norm();
    if (off < 0.15) p *= 1.0 + 0.3 * (1.0 - off / 0.15);
  }
  FitState state = test::fit_state(scan, test::editable(test::sphere(2)));
  state.round.evenness = 0.1;
  EXPECT_EQ(polish_nodes(state, 3), 0);  // early: angles only
  state.round.late = true;
  const auto farthest = [&] {
    double most = 0.0;
    for (const FitSample& s : state.samples) most = std::max(most, s.place.squared_distance);
    return std::sqrt(most);
  };
  const double before = farthest();
  const double rms_before = rms(state);
  EXPECT_GT(polish_nodes(state, 5), 0);
  test::expect_in_step(state);
  EXPECT_LT(farthest(), 0.7 * before);
  EXPECT_LT(rms(state), rms_before);
  EXPECT_TRUE(self_intersections({state.mesh.points, state.mesh.triangles}).empty());
}

TEST(FitPolish, MendsSmallAnglesAtAnyPrice) {
  const EditMesh sound = test::editable(test::sphere(2));
  constexpr std::int32_t v = 30;
  const std::int32_t w = sound.target(sound.first[v]);
  FitState state = with_one_off(v, 0.62 * (sound.points[w] - sound.points[v]));
  ASSERT_LT(test::smallest_angle(state.mesh), 30.0);
  int moved = 1;
  for (int pass = 0; pass < 10 && moved > 0; ++pass) moved = mend_angles(state, 30.0);
  EXPECT_GE(test::smallest_angle(state.mesh), 30.0);
  test::expect_in_step(state);
  EXPECT_EQ(mend_angles(state, 30.0), 0);
  EXPECT_TRUE(self_intersections({state.mesh.points, state.mesh.triangles}).empty());
}

}  // namespace
}  // namespace wscvt
