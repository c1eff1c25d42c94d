// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_state.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <utility>

#include "wscvt/base/pi.h"

namespace wscvt {

namespace {

/// A distance of so many times the rms distance counts twice its square. That keeps single places
/// from being given up for the mean.
constexpr double outlier_ratio = 3.0;

/// What a node's own distance to the original counts, in samples of a triangle. Without it a node
/// with few samples about it may come to stick out.
constexpr double node_share = 0.03;

}  // namespace

RefinementState::RefinementState(std::vector<Vector3> nodes, SphereTriangulation of_nodes,
                                 const MeshSurface& scan, double smallest_angle,
                                 const Execution& execution)
    : original(scan),
      samples(visible_samples(scan, of_nodes.triangles().size(), execution)),
      node_weight(node_share * static_cast<double>(samples.size()) /
                  static_cast<double>(of_nodes.triangles().size())),
      cosine_limit(std::cos(smallest_angle * pi / 180.0)),
      positions(std::move(nodes)),
      triangulation(std::move(of_nodes)),
      lists(samples_of_triangles(positions, triangulation, samples, execution)),
      errors(lists.size(), 0.0),
      node_errors(positions.size(), 0.0) {}

double RefinementState::error() const {
  return std::accumulate(errors.begin(), errors.end(), 0.0) +
         std::accumulate(node_errors.begin(), node_errors.end(), 0.0);
}

double RefinementState::measure(const Execution& execution) {
  const auto update = [&] {
    execution.parallel_for(lists.size(), refinement_block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        errors[t] = error_of(facet(triangulation.triangles()[t]), lists[t]);
      }
    });
  };
  // Twice: the weight of the fourth power follows from the mean of the plain squares.
  outlier_weight = 0.0;
  update();
  const double squares =
      std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(samples.size());
  if (squares > 0.0) outlier_weight = 1.0 / (outlier_ratio * outlier_ratio * squares);
  update();
  execution.parallel_for(positions.size(), refinement_block,
                         [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = begin; i < end; ++i) {
                             node_errors[i] = node_error(positions[i]);
                           }
                         });
  return std::sqrt(squares);
}

double RefinementState::node_residual(const Vector3& position, Vector3& normal) const {
  const Vector3 direction = position.normalized();
  RadialJet jet;
  original.evaluate(&direction, 1, Derivatives::First, &jet);
  normal = surface_normal(jet, direction);
  return normal.dot(direction) * (jet.radius - position.norm());
}

double RefinementState::node_error(const Vector3& position) const {
  Vector3 normal;
  return node_weight * penalty(node_residual(position, normal));
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

}  // namespace wscvt
