// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/nodes/fit_steps.h"

namespace wscvt {

namespace {

/// Samples beyond this many root mean squares are distant.
constexpr double far_sample = 4.0;
/// Longest step, in the edges about a node.
constexpr double longest_polish = 0.4;
/// Shorter steps, in the edges about a node, are not made.
constexpr double shortest_polish = 1e-4;
/// Smallest relative fall of the energy for a move.
constexpr double least_energy_fall = 1e-6;
constexpr double second_try = 0.3;
/// Pull of a single node to its ring's middle. In the step of all nodes, its neighbours' rings pull
/// it too.
constexpr double lone_ring = 1.17;

/// Returns which nodes have a sharp triangle or, in the late rounds, a distant sample.
std::vector<char> nodes_to_polish(const FitState& state) {
  std::vector<char> nodes(state.mesh.points.size(), 0);
  for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
    if (state.excess(t) <= 0.0) continue;
    for (const std::int32_t v : state.mesh.triangles[t]) nodes[v] = 1;
  }
  if (!state.round.late) return nodes;
  for (const FitSample& sample : state.samples) {
    if (sample.place.squared_distance <= far_sample * far_sample * state.mean_square) continue;
    for (const std::int32_t v : state.mesh.triangles[sample.face]) nodes[v] = 1;
  }
  return nodes;
}

bool fan_meets(const FitState& state, const FitFan& fan, const Vector3& at) {
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t next = (j + 1) % count;
    if (state.hash.meets(state.mesh, {fan.node, fan.nodes[j], fan.nodes[next]},
                         {at, fan.ring[j], fan.ring[next]}, fan.triangles, fan.node)) {
      return true;
    }
  }
  return false;
}

bool folds_more(const FitState& state, const FitFan& fan, const Vector3& at) {
  const double turn = sharpest_turn(state, at, fan.ring, fan.beyond, true);
  return turn < folded &&
         turn < sharpest_turn(state, fan.centre, fan.ring, fan.beyond, true) - 1e-9;
}

/// Finds a position at which the fan costs less.
bool find_better(const FitState& state, FitFan& fan, Vector3& at) {
  FanEquations equations;
  const double before = fan_energy(state, fan, fan.centre, &equations);
  const Vector3 step = equations.step(longest_polish * fan.rest);
  if (step.norm() < shortest_polish * fan.rest) return false;
  for (const double part : {1.0, second_try}) {
    at = fan.centre + part * step;
    if (fan_energy(state, fan, at) < before * (1.0 - least_energy_fall)) return true;
  }
  return false;
}

bool polish_node(FitState& state, std::int32_t v) {
  FitFan fan = fan_of(state, v);
  fan.rest = state.ring_edge(v);
  fan.spring = state.spring();
  fan.pull = lone_ring * state.ring();
  Vector3 at = fan.centre;
  if (!find_better(state, fan, at)) return false;
  const double sharpness_before = fan_sharpness(fan, fan.centre);
  const double sharpness_after = fan_sharpness(fan, at);
  if (!fan_is_fine(state, fan, at)) {
    if (fan_is_fine(state, fan, fan.centre) || sharpness_after > sharpness_before ||
        folds_more(state, fan, at)) {
      return false;
    }
  }
  if (state.round.late &&
      sharpness_after > std::max(sharpness_before, state.round.sharpness_limit)) {
    return false;
  }
  if (fan_meets(state, fan, at)) return false;
  state.mesh.points[v] = at;
  state.deal(fan.samples, fan.triangles, fan.places);
  for (const std::int32_t t : fan.triangles) state.hash.enter(state.mesh, t);
  return true;
}

/// Returns the step of a fan's node that enlarges its angles.
Vector3 angle_step(const FitState& state, const FitFan& fan) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vector3 right = Vector3::Zero();
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    std::array<Vector3, 3> gradient;
    const double excess =
        state.excess(fan.centre, fan.ring[j], fan.ring[(j + 1) % count], &gradient);
    if (excess <= 0.0) continue;
    matrix += gradient[0] * gradient[0].transpose();
    right -= excess * gradient[0];
  }
  matrix += (1e-6 * matrix.trace() + 1e-300) * Eigen::Matrix3d::Identity();
  return matrix.ldlt().solve(right);
}

/// A node's move that enlarges angles.
struct Mending {
  double cost = 1e300;
  std::int32_t v = -1;
  Vector3 at = Vector3::Zero();
};

bool mending_allowed(const FitState& state, const FitFan& fan, const Vector3& at) {
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const Vector3& x = fan.ring[j];
    const Vector3& y = fan.ring[(j + 1) % count];
    const Vector3 after = doubled_area_normal(at, x, y);
    const Vector3 before = doubled_area_normal(fan.centre, x, y);
    if (after.dot(before) < face_agreement * after.norm() * before.norm()) return false;
  }
  return !folds_more(state, fan, at) && !fan_meets(state, fan, at);
}

void look_for_mending(const FitState& state, std::int32_t v, double limit, Mending& best) {
  const FitFan fan = fan_of(state, v);
  const double before = fan_sharpness(fan, fan.centre);
  if (before <= limit) return;
  Vector3 middle = Vector3::Zero();
  for (const Vector3& x : fan.ring) middle += x / static_cast<double>(fan.ring.size());
  const Vector3 step = angle_step(state, fan);
  const Vector3 way = middle - fan.centre;
  constexpr double least_fall = 1e-4;   // of a cosine
  constexpr double miss_price = 100.0;  // mean squares per sample for an angle that stays small
  for (const Vector3& move : {Vector3(0.5 * step), step, Vector3(1.5 * step), Vector3(2.5 * step),
                              Vector3(0.15 * way), Vector3(0.3 * way), Vector3(0.6 * way), way}) {
    const Vector3 at = fan.centre + move;
    const double after = fan_sharpness(fan, at);
    if (!(after <= before - least_fall) || !mending_allowed(state, fan, at)) continue;
    double cost = 0.0;
    for (const std::int32_t s : fan.samples) {
      double nearest = 1e300;
      for (std::size_t j = 0; j < fan.ring.size(); ++j) {
        const MeasuredTriangle triangle(at, fan.ring[j], fan.ring[(j + 1) % fan.ring.size()]);
        nearest = std::min(nearest, triangle.nearest(state.samples[s].point).squared_distance);
      }
      cost += nearest;
    }
    if (after > limit) {
      cost += miss_price * state.mean_square * static_cast<double>(fan.samples.size()) *
              (after - limit) / (1.0 - limit);
    }
    if (cost < best.cost) best = {cost, v, at};
  }
}

}  // namespace

int polish_nodes(FitState& state, int passes) {
  int done = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<char> nodes = nodes_to_polish(state);
    const int before = done;
    for (std::size_t v = 0; v < nodes.size(); ++v) {
      if (nodes[v] != 0 && polish_node(state, static_cast<std::int32_t>(v))) ++done;
    }
    if (done == before) break;
  }
  return done;
}

int mend_angles(FitState& state, double least_angle) {
  const double limit = portable::cos(least_angle * pi / 180.0);
  const double goal = state.round.goal_cosine;
  state.round.goal_cosine = portable::cos((least_angle + 0.2) * pi / 180.0);  // a little beyond
  int moved = 0;
  for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
    if (state.mesh.sharpness(t) <= limit) continue;
    Mending best;
    for (const std::int32_t v : state.mesh.triangles[t]) look_for_mending(state, v, limit, best);
    if (best.v < 0) continue;
    const NodeRing ring = ring_of(state.mesh, best.v);
    const std::vector<std::int32_t> samples = state.pool(ring.triangles);
    state.mesh.points[best.v] = best.at;
    state.deal(samples, ring.triangles);
    for (const std::int32_t u : ring.triangles) state.hash.enter(state.mesh, u);
    ++moved;
  }
  state.round.goal_cosine = goal;
  return moved;
}

}  // namespace wscvt
