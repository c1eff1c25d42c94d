// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_state.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "wscvt/base/half_edges.h"

namespace wscvt {

namespace {

/// A distance of so many times the rms distance counts twice its square. That keeps single places
/// from being given up for the mean.
constexpr double outlier_ratio = 3.0;

/// What a node's own distance to the original counts, in samples of a triangle. Without it a node
/// with few samples about it may come to stick out.
constexpr double node_share = 0.03;

/// Edges may turn by 60 degrees everywhere, and by 120 nowhere that they did not before.
constexpr double free_turn_cosine = 0.5;
constexpr double largest_turn_cosine = -0.5;
/// Share of the samples whose normals say nothing about the surface.
constexpr double noisy_share = 0.05;

bool is_free(double after, double before) { return after >= std::min(free_turn_cosine, before); }

/// Whether the surface itself turns by as much as `after` among samples; for_each_list(visit) shows
/// their lists.
template <class ForEachList>
bool surface_turns(const RefinementSamples& samples, double after,
                   const ForEachList& for_each_list) {
  if (!(after >= largest_turn_cosine)) return false;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for_each_list([&](const SampleList& list) {
    for (const std::int32_t s : list) mean += samples.normals[s];
  });
  mean.normalize();
  std::vector<float> cosines;
  for_each_list([&](const SampleList& list) {
    for (const std::int32_t s : list) cosines.push_back(mean.dot(samples.normals[s]));
  });
  if (cosines.empty()) return false;
  // Both sides of a ridge lie half its turn from their mean. Few samples may be noise.
  const auto odd = static_cast<std::ptrdiff_t>(static_cast<double>(cosines.size()) * noisy_share);
  std::nth_element(cosines.begin(), cosines.begin() + odd, cosines.end());
  const double half_turn = std::acos(std::clamp<double>(cosines[index(odd)], 0.0, 1.0));
  return after >= std::cos(2.0 * half_turn);
}

}  // namespace

RefinementState::RefinementState(std::vector<RefinementNode> start, SphereTriangulation of_nodes,
                                 const RefinementTarget& scan, double smallest_angle,
                                 const Execution& execution)
    : original(scan),
      samples(scan.samples(of_nodes.triangles().size(), execution)),
      node_weight(node_share * static_cast<double>(samples.size()) /
                  static_cast<double>(of_nodes.triangles().size())),
      cosine_limit(cosine_of_degrees(smallest_angle)),
      nodes(std::move(start)),
      triangulation(std::move(of_nodes)),
      lists(samples_of_triangles(nodes, triangulation, samples, execution)),
      errors(lists.size(), 0.0),
      node_errors(nodes.size(), 0.0) {}

double RefinementState::error() const {
  return std::accumulate(errors.begin(), errors.end(), 0.0) +
         std::accumulate(node_errors.begin(), node_errors.end(), 0.0);
}

double RefinementState::measure(const Execution& execution, double angle_strength) {
  const auto update = [&] {
    execution.parallel_for(lists.size(), refinement_block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        errors[t] = error_of(facet(triangulation.triangles()[t]), lists[t]);
      }
    });
  };
  // Twice: the weights of the fourth power and of the angles follow from the mean of the plain
  // squares.
  outlier_weight = 0.0;
  angle_penalty.weight = 0.0;
  update();
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  const double squares = sum / static_cast<double>(samples.size());
  if (squares > 0.0) outlier_weight = 1.0 / (outlier_ratio * outlier_ratio * squares);
  angle_penalty.weight = angle_strength * sum / static_cast<double>(lists.size());
  update();
  execution.parallel_for(nodes.size(), refinement_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) node_errors[i] = node_error(nodes[i]);
  });
  return std::sqrt(squares);
}

int RefinementState::count_sharper(double cosine) const {
  const std::vector<Triangle>& triangles = triangulation.triangles();
  return static_cast<int>(std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return facet(t).largest_cosine > cosine;
  }));
}

Vector3 RefinementState::normal(std::int32_t triangle) const {
  const auto& [a, b, c] = triangulation.triangles()[triangle];
  return facet_normal(nodes[a].position, nodes[b].position, nodes[c].position);
}

double RefinementState::node_error(const RefinementNode& node) const {
  Vector3 normal;
  return node_weight * penalty(original.residual(node, normal));
}

bool RefinementState::may_turn(double after, double before, const std::vector<SampleList>& own,
                               const std::vector<std::int32_t>& beside) const {
  return is_free(after, before) || surface_turns(samples, after, [&](const auto& visit) {
           for (const SampleList& list : own) visit(list);
           for (const std::int32_t t : beside) visit(lists[t]);
         });
}

bool RefinementState::may_turn(double after, double before, const std::vector<std::int32_t>& own,
                               const std::vector<std::int32_t>& beside) const {
  return is_free(after, before) || surface_turns(samples, after, [&](const auto& visit) {
           for (const std::int32_t t : own) visit(lists[t]);
           for (const std::int32_t t : beside) visit(lists[t]);
         });
}

void RefinementState::ring_of(std::int32_t node, std::vector<std::int32_t>& ring,
                              std::vector<std::int32_t>* triangles) const {
  ring.clear();
  if (triangles != nullptr) triangles->clear();
  const std::int32_t first = triangulation.first_half_edge()[node];
  std::int32_t h = first;
  do {
    ring.push_back(triangulation.origin(SphereTriangulation::next(h)));
    if (triangles != nullptr) triangles->push_back(h / 3);
    h = triangulation.opposite()[SphereTriangulation::previous(h)];
  } while (h != first);
}

void RefinementState::outer_half_edges_of(std::int32_t node,
                                          std::vector<std::int32_t>& outer) const {
  outer.clear();
  const std::int32_t first = triangulation.first_half_edge()[node];
  std::int32_t h = first;
  do {
    outer.push_back(triangulation.opposite()[SphereTriangulation::next(h)]);
    h = triangulation.opposite()[SphereTriangulation::previous(h)];
  } while (h != first);
}

}  // namespace wscvt
