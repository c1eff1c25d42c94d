// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_fan.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

void RefinementFan::resize() {
  beside.resize(ring.size());
  outer.resize(ring.size());
  facets.resize(ring.size());
  errors.resize(ring.size());
  if (lists.size() < ring.size()) lists.resize(ring.size());
  for (std::size_t j = ring.size(); j < lists.size(); ++j) lists[j].clear();
}

double RefinementFan::turn() const {
  double smallest = 1.0;
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const Vector3& normal = facets[j].normal;
    smallest = std::min({smallest, normal.dot(facets[j == 0 ? ring.size() - 1 : j - 1].normal),
                         normal.dot(outer[j])});
  }
  return smallest;
}

FanLimits load_facets(const RefinementState& state, std::int32_t node, FanWorkspace& work) {
  RefinementFan& fan = work.fan;
  state.ring_of(node, fan.ring, &work.triangles);
  state.outer_half_edges_of(node, work.outer);
  fan.node = state.nodes[node];
  fan.resize();
  fan.error = state.node_errors[node];
  FanLimits limits;
  limits.largest_cosine = -1.0;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const std::int32_t t = work.triangles[j];
    fan.facets[j] = RefinementFacet(fan.node, state.nodes[fan.ring[j]],
                                    state.nodes[fan.ring[j + 1 == count ? 0 : j + 1]]);
    fan.beside[j] = work.outer[j] / 3;
    fan.outer[j] = state.normal(fan.beside[j]);
    limits.largest_cosine = std::max(limits.largest_cosine, fan.facets[j].largest_cosine);
    fan.error += state.errors[t];
  }
  limits.turn = fan.turn();
  return limits;
}

FanLimits load_fan(const RefinementState& state, std::int32_t node, FanWorkspace& work) {
  const FanLimits limits = load_facets(state, node, work);
  for (std::size_t j = 0; j < work.triangles.size(); ++j) {
    work.fan.lists[j] = state.lists[work.triangles[j]];
  }
  return limits;
}

void store_fan(RefinementState& state, std::int32_t node, FanWorkspace& work) {
  RefinementFan& fan = work.fan;
  state.nodes[node] = fan.node;
  state.node_errors[node] = fan.node_error;
  for (std::size_t j = 0; j < fan.ring.size(); ++j) {
    state.lists[work.triangles[j]].swap(fan.lists[j]);
    state.errors[work.triangles[j]] = fan.errors[j];
  }
}

bool place_fan(const RefinementState& state, const RefinementFan& from, const Vector3& position,
               const FanLimits& limits, RefinementFan& to, std::vector<Vector3>& spokes) {
  const std::size_t count = from.ring.size();
  to.ring = from.ring;
  to.beside = from.beside;
  to.outer = from.outer;
  to.node = state.original.node_at(position, from.node);
  to.resize();
  spokes.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    const RefinementNode& a = state.nodes[from.ring[j]];
    to.facets[j] = RefinementFacet(to.node, a, state.nodes[from.ring[j + 1 == count ? 0 : j + 1]]);
    if (!to.facets[j].acceptable(limits.largest_cosine)) return false;
    spokes[j] = to.node.direction.cross(a.direction);
    to.lists[j].clear();
  }
  if (!state.may_turn(to.turn(), limits.turn, from.lists, from.beside)) return false;
  for (std::size_t j = 0; j < count; ++j) {
    for (const std::int32_t s : from.lists[j]) {
      const Vector3& sample = state.samples.direction(s);
      // Most samples stay in their triangle; the others are found by going round the node. Only
      // the planes through the node are asked: the outer edges have not moved, and hold all the
      // fan's samples. One turn at most, since a sample on a spoke may round to either side of it.
      std::size_t k = j;
      for (std::size_t turn = 0; turn < count; ++turn) {
        const std::size_t after = k + 1 == count ? 0 : k + 1;
        if (spokes[k].dot(sample) < 0.0) {
          k = k == 0 ? count - 1 : k - 1;
        } else if (spokes[after].dot(sample) > 0.0) {
          k = after;
        } else {
          break;
        }
      }
      to.lists[k].push_back(s);
    }
  }
  to.node_error = state.node_error(to.node);
  to.error = to.node_error;
  for (std::size_t j = 0; j < count; ++j) {
    to.errors[j] = state.error_of(to.facets[j], to.lists[j]);
    to.error += to.errors[j];
  }
  return true;
}

namespace {

/// Gradient of a facet's AnglePenalty::excess by the position of its corner `node`; 1 / length. By
/// central differences, since which of three angles is the smallest may change on the way, and six
/// triangles cost little beside the samples of one.
Vector3 excess_gradient(const AnglePenalty& penalty, const RefinementNode& node,
                        const RefinementNode& a, const RefinementNode& b) {
  const double step = 1e-4 * (a.position - node.position).norm();
  Vector3 gradient;
  for (int k = 0; k < 3; ++k) {
    RefinementNode moved = node;
    moved.position[k] += step;
    const double above = penalty.excess({moved, a, b});
    moved.position[k] -= 2.0 * step;
    gradient[k] = (above - penalty.excess({moved, a, b})) / (2.0 * step);
  }
  return gradient;
}

}  // namespace

void add_angles(const RefinementState& state, const RefinementFan& fan, const AnglePenalty& penalty,
                Matrix3& matrix, Vector3& gradient) {
  if (!(penalty.weight > 0.0)) return;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const double excess = penalty.excess(fan.facets[j]);
    if (!(excess > 0.0)) continue;
    const RefinementNode& a = state.nodes[fan.ring[j]];
    const RefinementNode& b = state.nodes[fan.ring[j + 1 == count ? 0 : j + 1]];
    const Vector3 slope = excess_gradient(penalty, fan.node, a, b);
    matrix += penalty.weight * slope * slope.transpose();
    gradient -= penalty.weight * excess * slope;
  }
}

bool improve_fan(const RefinementState& state, FanWorkspace& work, const FanLimits& limits) {
  RefinementFan& fan = work.fan;
  const std::size_t count = fan.ring.size();
  Matrix3 matrix = Matrix3::Zero();
  Vector3 gradient = Vector3::Zero();
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < count; ++j) {
    const Vector3& a = state.nodes[fan.ring[j]].position;
    const Vector3& b = state.nodes[fan.ring[j + 1 == count ? 0 : j + 1]].position;
    shortest = std::min(shortest, (a - fan.node.position).norm());
    // When the node moves by one along the normal, the plane moves under a sample by the node's
    // barycentric coordinate at the sample's foot. Moves within the plane leave it where it is, so
    // that each triangle speaks for its own normal only, and the ridge between two planes is the
    // one direction in which a node on it may slide freely.
    const Vector3 edge = b - a;
    const Vector3 doubled_area = doubled_area_normal(fan.node.position, a, b);
    const Vector3 coordinate_gradient = doubled_area.cross(edge) / doubled_area.squaredNorm();
    const RefinementFacet& f = fan.facets[j];
    double squares = 0.0;
    double products = 0.0;
    for (const std::int32_t s : fan.lists[j]) {
      const double coordinate = coordinate_gradient.dot(state.samples.points[s] - a);
      const double residual = f.residual(state.samples.points[s]);
      const double weight = state.penalty_weight(residual);
      squares += weight * coordinate * coordinate;
      products += weight * coordinate * residual;
    }
    matrix += squares * f.normal * f.normal.transpose();
    gradient += products * f.normal;
  }
  add_angles(state, fan, state.angle_penalty, matrix, gradient);
  Vector3 normal;
  const double residual = state.original.residual(fan.node, normal);
  const double weight = state.node_weight * state.penalty_weight(residual);
  matrix += weight * normal * normal.transpose();
  gradient += weight * residual * normal;
  // Where the surface is flat the samples do not say where in the plane the node should stand: the
  // matrix is singular there, and a thousandth of its trace lets the node stay. The smallest
  // positive number keeps a fan without any samples from dividing by 0.
  matrix.diagonal().array() += 1e-3 * matrix.trace() + std::numeric_limits<double>::min();
  Vector3 step = matrix.ldlt().solve(gradient);
  const double length = step.norm();
  // Below that the step changes the mesh by no more than its file in single precision would.
  if (!(length > 1e-7 * shortest)) return false;
  // Farther than halfway to a neighbour the fan's samples no longer say what the surface does.
  if (length > 0.5 * shortest) step *= 0.5 * shortest / length;
  for (int attempt = 0; attempt < 3; ++attempt, step *= 0.4) {
    if (place_fan(state, fan, fan.node.position + step, limits, work.trial, work.spokes) &&
        work.trial.error < fan.error) {
      std::swap(work.fan, work.trial);
      return true;
    }
  }
  return false;
}

bool reach_for_outlier(const RefinementState& state, FanWorkspace& work, const FanLimits& limits) {
  const RefinementFan& fan = work.fan;
  double largest = 0.0;
  std::int32_t farthest = -1;
  for (std::size_t j = 0; j < fan.ring.size(); ++j) {
    for (const std::int32_t s : fan.lists[j]) {
      const double distance = std::abs(fan.facets[j].residual(state.samples.points[s]));
      if (!(distance > largest)) continue;
      largest = distance;
      farthest = s;
    }
  }
  if (!(state.outlier_weight * largest * largest > 1.0)) return false;
  const Vector3 start = fan.node.position;
  const Vector3 way = state.samples.points[farthest] - start;
  for (const double share : {1.0, 0.5}) {
    if (place_fan(state, fan, start + share * way, limits, work.trial, work.spokes) &&
        work.trial.error < fan.error) {
      std::swap(work.fan, work.trial);
      return true;
    }
  }
  return false;
}

}  // namespace wscvt
