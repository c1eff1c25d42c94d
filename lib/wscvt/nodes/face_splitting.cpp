// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/face_splitting.h"

#include <algorithm>
#include <queue>

namespace wscvt {

namespace {

struct LongEdge {
  double squared_length;
  std::int32_t half_edge;
  std::int32_t from;
  std::int32_t to;

  bool operator<(const LongEdge& other) const {
    if (squared_length != other.squared_length) return squared_length < other.squared_length;
    return half_edge < other.half_edge;
  }
};

}  // namespace

std::vector<std::array<std::int32_t, 2>> split_long_edges(EditMesh& mesh, double length,
                                                          const Execution& execution) {
  constexpr std::size_t splits_a_report = 1 << 16;
  std::priority_queue<LongEdge> edges;
  const auto enter = [&](std::int32_t h) {
    const std::int32_t from = mesh.origin(h);
    const std::int32_t to = mesh.target(h);
    const double squared = (mesh.points[from] - mesh.points[to]).squaredNorm();
    if (squared > length * length) edges.push({squared, h, from, to});
  };
  for (std::size_t h = 0; h < mesh.opposite.size(); ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    if (half_edge < mesh.opposite[h]) enter(half_edge);
  }
  std::vector<std::array<std::int32_t, 2>> ends;
  while (!edges.empty()) {
    const LongEdge edge = edges.top();
    edges.pop();
    // Splits nearby renumber half-edges.
    if (mesh.origin(edge.half_edge) != edge.from || mesh.target(edge.half_edge) != edge.to) {
      continue;
    }
    if (ends.size() % splits_a_report == 0) execution.report(0.0, "Splitting the scan's faces");
    const auto v = static_cast<std::int32_t>(mesh.points.size());
    const auto free = static_cast<std::int32_t>(mesh.triangles.size());
    mesh.points.push_back(0.5 * (mesh.points[edge.from] + mesh.points[edge.to]));
    mesh.first.push_back(-1);
    mesh.degrees.push_back(0);
    mesh.triangles.resize(mesh.triangles.size() + 2);
    mesh.opposite.resize(mesh.opposite.size() + 6, -1);
    mesh.put_on_edge(v, edge.half_edge, {free, free + 1});
    ends.push_back({edge.from, edge.to});
    mesh.around(v, [&](std::int32_t h) {
      enter(h);
      enter(next_half_edge(h));
    });
  }
  return ends;
}

}  // namespace wscvt
