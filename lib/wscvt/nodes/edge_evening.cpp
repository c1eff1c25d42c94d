// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/edge_evening.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/nodes/self_intersections.h"

namespace wscvt {

namespace {

constexpr std::size_t evening_block = 256;

/// Of the way that the majorization says, which is short: it bounds the stress as if that rose
/// across an edge as it does along it. 1.6 gains no more.
constexpr double over_relaxation = 1.4;

/// Lengths that the edges of a mesh should have.
class WantedLengths {
 public:
  WantedLengths(const IndexedMesh& nodes, const std::vector<double>& spacings)
      : nodes_(nodes), spacings_(spacings) {}

  /// In units of the spacings.
  double operator()(std::int32_t a, std::int32_t b) const {
    return spacings_.empty() ? 1.0 : 0.5 * (spacings_[a] + spacings_[b]);
  }

  /// The unit that leaves edges between such points as long as they are in the mean; length.
  double unit(const std::vector<Vector3>& points) const {
    double lengths = 0.0;
    double wanted = 0.0;
    visit_edges(points, [&](double length, double target) {
      lengths += length;
      wanted += target;
    });
    return lengths / wanted;
  }

  /// Standard deviation of length / wanted length.
  double deviation(const std::vector<Vector3>& points) const {
    const double scale = unit(points);
    double squares = 0.0;
    visit_edges(points, [&](double length, double target) {
      const double excess = length / (scale * target) - 1.0;
      squares += excess * excess;
    });
    return std::sqrt(squares / (3.0 * static_cast<double>(nodes_.triangles.size())));
  }

 private:
  /// Calls visit(length, wanted length) twice for each edge.
  template <class Visit>
  void visit_edges(const std::vector<Vector3>& points, const Visit& visit) const {
    for (const Triangle& t : nodes_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = t[k];
        const std::int32_t b = t[following(k)];
        visit((points[b] - points[a]).norm(), (*this)(a, b));
      }
    }
  }

  const IndexedMesh& nodes_;
  const std::vector<double>& spacings_;
};

/// The step of each node in one round.
std::vector<Vector3> steps_of(const IndexedMesh& mesh, const HalfEdges& half_edges,
                              const WantedLengths& wanted, const Execution& execution) {
  const double unit = wanted.unit(mesh.points);
  const std::vector<Vector3> normals = vertex_normals(mesh.points, mesh.triangles);
  std::vector<Vector3> steps(mesh.points.size());
  execution.parallel_for(steps.size(), evening_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vector3 pull = Vector3::Zero();
      int neighbours = 0;
      visit_outgoing(half_edges.opposite, half_edges.first[i], [&](std::int32_t h) {
        const std::int32_t other = target_of(mesh.triangles, h);
        const Vector3 edge = mesh.points[other] - mesh.points[i];
        const double length = edge.norm();
        ++neighbours;
        // Two nodes at one place say nothing about a direction.
        if (!(length > 0.0)) return;
        pull += (1.0 - unit * wanted(static_cast<std::int32_t>(i), other) / length) * edge;
      });
      steps[i] = over_relaxation / neighbours * (pull - pull.dot(normals[i]) * normals[i]);
    }
  });
  return steps;
}

}  // namespace

void check_edge_evening_options(const EdgeEveningOptions& options) {
  require_in_range(options.rounds, evening_rounds_option);
  require_in_range(options.limits.smallest_angle, evening_angle_option);
  require_in_range(options.limits.largest_turn, evening_turn_option);
}

EvenedEdges even_edges(const IndexedMesh& nodes, const std::vector<double>& spacings,
                       const EdgeEveningOptions& options, const Execution& execution) {
  check_edge_evening_options(options);
  const std::size_t count = nodes.points.size();
  if (!spacings.empty() && spacings.size() != count) {
    throw Error(ErrorCode::InvalidInput, "There are " + std::to_string(count) + " nodes, but " +
                                             std::to_string(spacings.size()) +
                                             " spacings; give one each, or none.");
  }
  const HalfEdges half_edges = link_half_edges(nodes.triangles, count, execution);
  const WantedLengths wanted(nodes, spacings);
  IndexedMesh mesh = nodes;
  for (int round = 0; round < options.rounds; ++round) {
    mesh.points = GuardedSteps(mesh, half_edges, steps_of(mesh, half_edges, wanted, execution),
                               options.limits, execution)
                      .positions();
  }
  // All rounds at once, for what has to be taken back where triangles meet that did not.
  std::vector<Vector3> ways(count);
  for (std::size_t i = 0; i < count; ++i) ways[i] = mesh.points[i] - nodes.points[i];
  GuardedSteps guarded(nodes, half_edges, std::move(ways), options.limits, execution);
  std::optional<std::size_t> pairs_before;  // counted when some are found, which is rare
  EvenedEdges result;
  for (bool held = true; held;) {
    result.positions = guarded.positions();
    const auto pairs = self_intersections({result.positions, nodes.triangles}, execution);
    if (pairs.empty()) break;
    if (!pairs_before) pairs_before = self_intersections(nodes, execution).size();
    if (pairs.size() <= *pairs_before) break;
    held = false;
    for (const std::int32_t v : vertices_of(pairs, nodes.triangles)) held |= guarded.hold_back(v);
  }
  result.report.held_back = guarded.held_back();
  result.report.deviation_before = wanted.deviation(nodes.points);
  result.report.deviation_after = wanted.deviation(result.positions);
  return result;
}

}  // namespace wscvt
