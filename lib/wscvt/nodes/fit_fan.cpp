// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/fit_fan.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace wscvt {

namespace {

/// Keeps the 3 by 3 system solvable for a fan with few samples.
constexpr double fan_damping = 1e-3;
/// As in the step of all nodes, samples beyond a rim pull along the triangle.
constexpr double fan_rim_pull = 2.0;
/// A node needs a sample within this fraction of a spoke.
constexpr double near_sample = 0.3;

/// The triangle of a fan nearest to a sample, and the position in it.
struct FanPlace {
  std::size_t triangle = 0;
  TrianglePlace place;
};

/// Searches from the sample's last triangle to both sides as long as they get nearer.
FanPlace place_in_fan(const FitFan& fan, const Vector3& at, const Vector3& point,
                      std::int32_t last) {
  const std::size_t count = fan.ring.size();
  FanPlace best;
  best.place.squared_distance = 1e300;
  const auto look = [&](std::size_t j) {
    const TrianglePlace place =
        nearest_in_triangle(point, at, fan.ring[j], fan.ring[j + 1 == count ? 0 : j + 1]);
    if (place.squared_distance >= best.place.squared_distance) return false;
    best = {j, place};
    return true;
  };
  if (last < 0) {
    for (std::size_t j = 0; j < count; ++j) look(j);
    return best;
  }
  look(last);
  if (best.place.region == 0) return best;
  const auto start = static_cast<std::size_t>(last);
  bool forwards = false;
  for (std::size_t i = 1; i < count && look((start + i) % count); ++i) forwards = true;
  if (forwards) return best;
  for (std::size_t i = 1; i < count && look((start + count - i) % count); ++i) {
  }
  return best;
}

FanPlace remembered_place(const FitState& state, FitFan& fan, const Vector3& at, std::size_t i) {
  const FanPlace place = place_in_fan(fan, at, state.samples[fan.samples[i]].point, fan.places[i]);
  fan.places[i] = static_cast<std::int32_t>(place.triangle);
  return place;
}

void add_sample(const FitState& state, const FitFan& fan, const Vector3& at,
                const FitSample& sample, const FanPlace& in, const Vector3& normal,
                FanEquations& equations) {
  const std::size_t next = (in.triangle + 1) % fan.ring.size();
  const Vector3 r = in.place.point(at, fan.ring[in.triangle], fan.ring[next]) - sample.point;
  const Vector3 u =
      sample.normal.dot(normal) < 0.0 ? normal : Vector3((sample.normal + normal).normalized());
  const double weight = state.share() * state.weight(in.place.squared_distance);
  const double off = u.dot(r);
  const double w = in.place.weights[0];
  equations.matrix += weight * w * w * u * u.transpose();
  equations.right -= weight * w * off * u;
  if (in.place.region == 0) return;
  const Vector3 beyond = r - off * u;
  const double squared = beyond.squaredNorm();
  if (squared <= 1e-20) return;
  equations.matrix += weight * fan_rim_pull * w * w / squared * beyond * beyond.transpose();
  equations.right -= weight * fan_rim_pull * w * beyond;
}

double add_triangles(const FitState& state, const FitFan& fan, const Vector3& at,
                     FanEquations* equations) {
  double energy = 0.0;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    std::array<Vector3, 3> gradient;
    const double excess = state.excess(at, fan.ring[j], fan.ring[(j + 1) % count], &gradient);
    const Vector3 spoke = at - fan.ring[j];
    const double length = spoke.norm() + 1e-300;
    energy += state.round.price * excess * excess +
              fan.spring * (length - fan.rest) * (length - fan.rest);
    if (equations == nullptr) continue;
    if (excess > 0.0) {
      equations->matrix += state.round.price * gradient[0] * gradient[0].transpose();
      equations->right -= state.round.price * excess * gradient[0];
    }
    const Vector3 u = spoke / length;
    equations->matrix += fan.spring * u * u.transpose();
    equations->right -= fan.spring * (length - fan.rest) * u;
  }
  return energy;
}

double add_pull(const FitState& state, const FitFan& fan, const Vector3& at,
                FanEquations* equations) {
  Vector3 centre = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
  double weights = 0.0;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const double weight = state.ring_weight(fan.node, fan.nodes[j]);
    weights += weight;
    centre += weight * fan.ring[j];
    normal += doubled_area_normal(at, fan.ring[j], fan.ring[(j + 1) % count]);
  }
  centre /= weights;
  normal /= normal.norm() + 1e-300;
  const Vector3 off = at - centre;
  const Vector3 flat = off - normal.dot(off) * normal;
  if (equations != nullptr) {
    equations->matrix += fan.pull * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
    equations->right -= fan.pull * flat;
  }
  return fan.pull * flat.squaredNorm();
}

}  // namespace

Vector3 FanEquations::step(double most) const {
  Vector3 result = (matrix + fan_damping * Eigen::Matrix3d::Identity()).ldlt().solve(right);
  const double length = result.norm();
  if (length > most) result *= most / length;
  return result;
}

double fan_energy(const FitState& state, FitFan& fan, const Vector3& at, FanEquations* equations) {
  const std::size_t count = fan.ring.size();
  std::vector<Vector3> normals;
  if (equations != nullptr) {
    normals.resize(count);
    for (std::size_t j = 0; j < count; ++j) {
      normals[j] = unit_normal_of(at, fan.ring[j], fan.ring[(j + 1) % count]);
    }
  }
  double energy = 0.0;
  for (std::size_t i = 0; i < fan.samples.size(); ++i) {
    const FanPlace in = remembered_place(state, fan, at, i);
    energy += state.share() * state.error(in.place.squared_distance);
    if (equations != nullptr) {
      add_sample(state, fan, at, state.samples[fan.samples[i]], in, normals[in.triangle],
                 *equations);
    }
  }
  energy += add_triangles(state, fan, at, equations);
  if (fan.pull > 0.0) energy += add_pull(state, fan, at, equations);
  return energy;
}

bool fan_is_fine(const FitState& state, FitFan& fan, const Vector3& at,
                 const std::vector<Vector3>& about) {
  constexpr int enough = 3;
  const std::size_t count = fan.ring.size();
  std::vector<Vector3> sums(count, Vector3::Zero());
  std::vector<int> counts(count, 0);
  double nearest = 1e300;
  for (std::size_t i = 0; i < fan.samples.size(); ++i) {
    const FanPlace in = remembered_place(state, fan, at, i);
    const FitSample& sample = state.samples[fan.samples[i]];
    sums[in.triangle] += sample.normal;
    ++counts[in.triangle];
    nearest = std::min(nearest, (sample.point - at).squaredNorm());
  }
  if (nearest > near_sample * near_sample * fan.rest * fan.rest) return false;
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t next = (j + 1) % count;
    Vector3 outward = sums[j];
    if (counts[j] < enough) {
      if (counts[j] > 0) outward /= counts[j];
      outward += about[fan.nodes[j]] + about[fan.nodes[next]];
    }
    const Vector3 normal = unit_normal_of(at, fan.ring[j], fan.ring[next]);
    if (normal.dot(outward) < face_agreement * outward.norm()) return false;
    if (largest_corner_cosine(at, fan.ring[j], fan.ring[next]) > state.round.early_sharpness) {
      return false;
    }
  }
  return true;
}

double fan_sharpness(const FitFan& fan, const Vector3& at) {
  double sharpest = 0.0;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    sharpest =
        std::max(sharpest, largest_corner_cosine(at, fan.ring[j], fan.ring[(j + 1) % count]));
  }
  return sharpest;
}

FitFan fan_of(const FitState& state, std::int32_t v, const NodeRing& ring) {
  FitFan fan;
  fan.node = v;
  fan.centre = state.mesh.points[v];
  fan.nodes = ring.nodes;
  for (const std::int32_t y : ring.nodes) fan.ring.push_back(state.mesh.points[y]);
  for (std::size_t j = 0; j < ring.triangles.size(); ++j) {
    const std::vector<std::int32_t>& samples = state.of[ring.triangles[j]];
    fan.samples.insert(fan.samples.end(), samples.begin(), samples.end());
    fan.places.insert(fan.places.end(), samples.size(), static_cast<std::int32_t>(j));
  }
  return fan;
}

}  // namespace wscvt
