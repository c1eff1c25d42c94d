// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/fit_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wscvt {

namespace {

/// Squared distances above this many mean squares get no larger weight in a sample's cost.
constexpr double farthest_error = 18.0;
constexpr std::size_t placed_samples_block = 2048;
/// Added distance of a triangle that faces away from a sample by more than 60 degrees, in mean
/// edges per missing cosine: up to three mean edges.
constexpr double turned_distance = 2.0;

/// Returns the nearest triangle that faces as the sample does, from star to star of the nearest
/// nodes.
std::int32_t first_face(const EditMesh& mesh, const std::vector<Vector3>& normals,
                        const FitSample& sample, std::int32_t node, double edge) {
  constexpr int most_stars = 100;
  std::int32_t face = -1;
  double best = 1e300;
  for (int star = 0; star < most_stars; ++star) {
    std::int32_t next = -1;
    mesh.around(node, [&](std::int32_t h) {
      const std::size_t t = face_of(h);
      const double cosine = normals[t].dot(sample.normal);
      const double turned = turned_distance * edge * std::max(0.0, face_agreement - cosine);
      if (turned * turned >= best) return;
      const TrianglePlace place = nearest_in_triangle(sample.point, mesh, t);
      const double cost = place.squared_distance + turned * turned;
      if (cost >= best) return;
      best = cost;
      face = static_cast<std::int32_t>(t);
      Eigen::Index corner = 0;
      place.weights.maxCoeff(&corner);
      next = mesh.triangles[t][corner];
    });
    if (next < 0 || next == node) break;
    node = next;
  }
  return face;
}

}  // namespace

FitState::FitState(EditMesh start, std::vector<FitSample> scan_samples,
                   const std::vector<std::int32_t>& near, const FitDial& fit_dial,
                   const Execution& execution)
    : mesh(std::move(start)), samples(std::move(scan_samples)), dial(fit_dial) {
  edge = mean_edge_length(mesh);
  std::vector<Vector3> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) normals[t] = unit_normal(t);
  execution.parallel_for(
      samples.size(), placed_samples_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
          std::int32_t face = static_cast<std::int32_t>(face_of(mesh.first[near[s]]));
          walk_to_nearest(samples[s].point, mesh, face);
          samples[s].face = normals[face].dot(samples[s].normal) >= face_agreement
                                ? face
                                : first_face(mesh, normals, samples[s], near[s], edge);
        }
      });
  place_samples(execution);
  // Neighbours in space become neighbours in memory.
  std::stable_sort(samples.begin(), samples.end(),
                   [](const FitSample& a, const FitSample& b) { return a.face < b.face; });
}

double FitState::weight(double squared_distance) const {
  return 1.0 + robust_weight * std::min(squared_distance / mean_square, most_robust);
}

double FitState::error(double squared_distance) const {
  return squared_distance *
         (1.0 + 0.5 * robust_weight * std::min(squared_distance / mean_square, farthest_error));
}

double FitState::excess(const Vector3& a, const Vector3& b, const Vector3& c,
                        std::array<Vector3, 3>* gradient) const {
  const std::array<const Vector3*, 3> x = {&a, &b, &c};
  const std::array<double, 3> l = {(b - c).squaredNorm(), (c - a).squaredNorm(),
                                   (a - b).squaredNorm()};
  const auto k = static_cast<std::size_t>(std::min_element(l.begin(), l.end()) - l.begin());
  const std::size_t i = following(k);
  const std::size_t j = preceding(k);
  Vector3 to_i = *x[i] - *x[k];
  Vector3 to_j = *x[j] - *x[k];
  const double length_i = to_i.norm() + 1e-300;
  const double length_j = to_j.norm() + 1e-300;
  to_i /= length_i;
  to_j /= length_j;
  const double cosine = to_i.dot(to_j);
  if (cosine <= round.goal_cosine) return 0.0;
  const double scale = 1.0 / (1.0 - round.goal_cosine);
  if (gradient != nullptr) {
    (*gradient)[i] = scale / length_i * (to_j - cosine * to_i);
    (*gradient)[j] = scale / length_j * (to_i - cosine * to_j);
    (*gradient)[k] = -(*gradient)[i] - (*gradient)[j];
  }
  return (cosine - round.goal_cosine) * scale;
}

double FitState::excess(std::size_t t) const {
  const auto& [a, b, c] = mesh.triangles[t];
  return excess(mesh.points[a], mesh.points[b], mesh.points[c]);
}

void FitState::place_samples(const Execution& execution) {
  const double sum = execution.parallel_sum(
      samples.size(), placed_samples_block, 0.0, [&](std::size_t begin, std::size_t end) {
        double part = 0.0;
        for (std::size_t s = begin; s < end; ++s) {
          samples[s].place = walk_to_nearest(samples[s].point, mesh, samples[s].face);
          part += samples[s].place.squared_distance;
        }
        return part;
      });
  mean_square = std::max(sum / static_cast<double>(samples.size()), 1e-300);
}

void FitState::list_samples() {
  of.resize(mesh.triangles.size());
  for (std::vector<std::int32_t>& list : of) list.clear();
  sample_normals.assign(mesh.triangles.size(), Vector3::Zero());
  for (std::size_t s = 0; s < samples.size(); ++s) {
    of[samples[s].face].push_back(static_cast<std::int32_t>(s));
    sample_normals[samples[s].face] += samples[s].normal;
  }
  about = node_normals();
}

void FitState::deal(const std::vector<std::int32_t>& pool,
                    const std::vector<std::int32_t>& triangles) {
  for (const std::int32_t t : triangles) {
    of[t].clear();
    sample_normals[t].setZero();
  }
  for (const std::int32_t s : pool) {
    FitSample& sample = samples[s];
    double best = 1e300;
    for (const std::int32_t t : triangles) {
      const TrianglePlace place = nearest_in_triangle(sample.point, mesh, t);
      if (place.squared_distance >= best) continue;
      best = place.squared_distance;
      sample.place = place;
      sample.face = t;
    }
    of[sample.face].push_back(s);
    sample_normals[sample.face] += sample.normal;
  }
}

std::vector<std::int32_t> FitState::pool(const std::vector<std::int32_t>& triangles) const {
  std::vector<std::int32_t> result;
  for (const std::int32_t t : triangles) result.insert(result.end(), of[t].begin(), of[t].end());
  return result;
}

std::vector<Vector3> FitState::node_normals() const {
  std::vector<Vector3> normals(mesh.points.size(), Vector3::Zero());
  std::vector<double> sums(mesh.points.size(), 1e-300);
  for (const FitSample& sample : samples) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = mesh.triangles[sample.face][k];
      normals[v] += sample.place.weights[k] * sample.normal;
      sums[v] += sample.place.weights[k];
    }
  }
  for (std::size_t v = 0; v < normals.size(); ++v) normals[v] /= sums[v];
  return normals;
}

void FitState::read_spacing() {
  const bool even = std::all_of(samples.begin(), samples.end(),
                                [](const FitSample& sample) { return sample.spacing == 1.0; });
  if (even) return;
  if (spacing.empty()) spacing.assign(mesh.points.size(), 1.0);
  std::vector<double> sums(mesh.points.size(), 0.0);
  std::vector<double> weights(mesh.points.size(), 0.0);
  for (const FitSample& sample : samples) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = mesh.triangles[sample.face][k];
      sums[v] += sample.place.weights[k] * sample.spacing;
      weights[v] += sample.place.weights[k];
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (weights[v] > 0.0) spacing[v] = sums[v] / weights[v];
  }
}

Vector3 FitState::unit_normal(std::size_t t) const {
  const auto& [a, b, c] = mesh.triangles[t];
  return unit_normal_of(mesh.points[a], mesh.points[b], mesh.points[c]);
}

Vector3 unit_normal_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = doubled_area_normal(a, b, c);
  return normal / (normal.norm() + 1e-300);
}

NodeRing ring_of(const EditMesh& mesh, std::int32_t v) {
  NodeRing ring;
  mesh.around(v, [&](std::int32_t h) {
    ring.nodes.push_back(mesh.target(h));
    ring.triangles.push_back(static_cast<std::int32_t>(face_of(h)));
    ring.beyond.push_back(static_cast<std::int32_t>(face_of(mesh.opposite[next_half_edge(h)])));
  });
  return ring;
}

double sharpest_turn(const FitState& state, const Vector3& centre, const std::vector<Vector3>& ring,
                     const std::vector<std::int32_t>& beyond, bool closed) {
  const std::size_t count = ring.size();
  const std::size_t triangles = closed ? count : count - 1;
  double least = 1.0;
  Vector3 first = Vector3::Zero();
  Vector3 last = Vector3::Zero();
  for (std::size_t j = 0; j < triangles; ++j) {
    const Vector3 normal = unit_normal_of(centre, ring[j], ring[(j + 1) % count]);
    least = std::min(least, normal.dot(state.unit_normal(beyond[j])));
    if (j == 0) {
      first = normal;
    } else {
      least = std::min(least, normal.dot(last));
    }
    last = normal;
  }
  return closed ? std::min(least, last.dot(first)) : least;
}

}  // namespace wscvt
