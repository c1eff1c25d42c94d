// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/fit_bodies.h"
#include "wscvt/nodes/fit_steps.h"

namespace wscvt {
namespace {

/// Takes the step without guards; the nodes' mean square distance afterwards.
double after_step(FitState& state) {
  const std::vector<Vector3> step = fit_step(state, Execution(1));
  for (std::size_t i = 0; i < step.size(); ++i) state.mesh.points[i] += step[i];
  state.place_samples(Execution(1));
  state.list_samples();
  return test::mean_square(state);
}

double longest(const std::vector<Vector3>& steps) {
  double most = 0.0;
  for (const Vector3& step : steps) most = std::max(most, step.norm());
  return most;
}

TEST(FitStep, LeavesAnEvenMeshThatIsTheScanItself) {
  const IndexedMesh ball = test::icosahedron();
  FitState state = test::fit_state(ball, test::editable(ball), 1.1, 3000);  // some at each corner
  // Samples in the planes of the faces, with their normals, ask for nothing, nor do even edges.
  for (FitSample& sample : state.samples) {
    sample.normal = state.unit_normal(static_cast<std::size_t>(sample.face));
  }
  EXPECT_LT(longest(fit_step(state, Execution(1))), 1e-9);
  for (const double edge : state.ring_edges) EXPECT_NEAR(edge, state.edge, 1e-12);
}

TEST(FitStep, BringsNodesToTheScanFromBothSides) {
  const IndexedMesh body = test::scaled(test::lumpy(4), Vector3(1.3, 1.0, 0.9));
  const EditMesh nodes = test::clusters(body, 200);
  for (const double factor : {0.97, 1.03}) {
    SCOPED_TRACE(factor);
    EditMesh moved = nodes;
    for (Vector3& p : moved.points) p *= factor;
    FitState state = test::fit_state(body, moved);
    const double before = test::mean_square(state);
    EXPECT_LT(after_step(state), 0.1 * before);
  }
}

TEST(FitStep, MovesNodesIntoTheRidgesThatTheirCellsHold) {
  // A wedge-like box, turned; a node near an edge has samples of both sides.
  const Eigen::Matrix3d turn = test::random_rotation(9);
  const IndexedMesh box = test::transformed(test::subdivided(test::box(1.0, 1.1, 1.2), 4), turn,
                                            Vector3(0.2, 0.1, -0.3));
  FitState state = test::fit_state(box, test::clusters(box, 300));
  state.round.evenness = 0.05;
  const auto near_rims = [&] {
    int count = 0;
    for (const Vector3& p : state.mesh.points) {
      const Vector3 q =
          (turn.transpose() * (p - Vector3(0.2, 0.1, -0.3))).cwiseAbs() - Vector3(0.5, 0.55, 0.6);
      if ((q.array().abs() < 0.004).count() >= 2) ++count;
    }
    return count;
  };
  // As clusters that do not stay on rims leave them: a third of an edge inside.
  for (Vector3& p : state.mesh.points) {
    p = Vector3(0.2, 0.1, -0.3) + 0.93 * (p - Vector3(0.2, 0.1, -0.3));
  }
  state.place_samples(Execution(1));
  const int before = near_rims();
  for (int round = 0; round < 4; ++round) after_step(state);
  EXPECT_LT(before, 20);
  EXPECT_GT(near_rims(), 50);  // 14 units of edges, .17 apart
}

TEST(FitStep, PullsEdgesToTheirRestTheMoreTheEvenerItIs) {
  const IndexedMesh body = test::lumpy(4);
  const EditMesh nodes = test::clusters(body, 200);
  const auto ratio_at = [&](double evenness) {
    FitState state = test::fit_state(body, nodes);
    state.round.evenness = evenness;
    for (int round = 0; round < 3; ++round) after_step(state);
    return mean_edge_ratio(state.mesh);
  };
  const double weak = ratio_at(0.01);
  const double even = ratio_at(2.0);
  EXPECT_LT(even, mean_edge_ratio(nodes) - 0.05);
  EXPECT_LT(even, weak - 0.03);
}

TEST(FitStep, KeepsAWantedSpacing) {
  const IndexedMesh ball = test::sphere(4);
  FitState state = test::fit_state(ball, test::clusters(ball, 300));
  for (FitSample& sample : state.samples) sample.spacing = sample.point.z() > 0.0 ? 1.3 : 0.7;
  state.read_spacing();
  state.round.evenness = 2.0;
  for (int round = 0; round < 6; ++round) {
    after_step(state);
    state.read_spacing();
  }
  double upper = 0.0;
  double lower = 0.0;
  for (std::size_t i = 0; i < state.mesh.points.size(); ++i) {
    if (state.mesh.points[i].z() > 0.3) upper = std::max(upper, state.ring_edges[i]);
    if (state.mesh.points[i].z() < -0.3) lower = std::max(lower, state.ring_edges[i]);
  }
  EXPECT_GT(upper, 1.15 * lower);
}

TEST(FitStep, ListsTheMeanEdgeAboutEachNode) {
  const IndexedMesh body = test::lumpy(3);
  FitState state = test::fit_state(body, test::clusters(body, 100));
  fit_step(state, Execution(1));
  for (std::size_t v = 0; v < 100; ++v) {
    double sum = 0.0;
    state.mesh.around(static_cast<std::int32_t>(v), [&](std::int32_t h) {
      sum += (state.mesh.points[v] - state.mesh.points[state.mesh.target(h)]).norm();
    });
    EXPECT_NEAR(state.ring_edges[v], sum / state.mesh.degrees[v], 1e-12);
  }
}

TEST(FitStep, PricesSharpTriangles) {
  const IndexedMesh ball = test::sphere(4);
  EditMesh nodes = test::editable(test::icosahedron());
  nodes = test::editable(test::sphere(1));
  // One node slides towards a neighbour.
  const std::int32_t v = 5;
  const std::int32_t w = nodes.target(nodes.first[v]);
  nodes.points[v] = (0.25 * nodes.points[v] + 0.75 * nodes.points[w]).normalized();
  FitState state = test::fit_state(ball, nodes);
  state.round.evenness = 1e-6;
  // A tenth of the step, because what is linear in it is only true near.
  const auto angle_after = [&](double price) {
    FitState priced = state;
    priced.round.price = price;
    const std::vector<Vector3> step = fit_step(priced, Execution(1));
    for (std::size_t i = 0; i < step.size(); ++i) priced.mesh.points[i] += 0.1 * step[i];
    return test::smallest_angle(priced.mesh);
  };
  EXPECT_GT(angle_after(10.0), angle_after(0.0) + 0.5);
}

TEST(FitStep, IsTheSameOnAnyNumberOfThreads) {
  const IndexedMesh body = test::lumpy(4);
  FitState one = test::fit_state(body, test::clusters(body, 1500), 1.3, 10);
  FitState three = one;
  EXPECT_EQ(fit_step(one, Execution(1)), fit_step(three, Execution(3)));
}

}  // namespace
}  // namespace wscvt
