// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/long_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Squared length, half-edge, and its ends.
using LongEdge = std::tuple<double, std::int32_t, std::int32_t, std::int32_t>;

/// Returns the ends of each new vertex's edge, in order; they may be new vertices themselves.
std::vector<std::array<std::int32_t, 2>> split(EditMesh& mesh, double length, std::size_t most,
                                               const Execution& execution) {
  constexpr std::size_t splits_a_report = 1 << 16;
  std::priority_queue<LongEdge> edges;
  const auto enter = [&](std::int32_t h) {
    const std::int32_t from = mesh.origin(h);
    const std::int32_t to = mesh.target(h);
    const double squared = (mesh.points[from] - mesh.points[to]).squaredNorm();
    if (squared > length * length) edges.emplace(squared, h, from, to);
  };
  for (std::size_t h = 0; h < mesh.opposite.size(); ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    if (half_edge < mesh.opposite[h]) enter(half_edge);
  }
  std::vector<std::array<std::int32_t, 2>> ends;
  while (!edges.empty()) {
    const auto [squared, half_edge, from, to] = edges.top();
    edges.pop();
    // Splits nearby renumber half-edges.
    if (mesh.origin(half_edge) != from || mesh.target(half_edge) != to) continue;
    if (ends.size() == most) {
      refuse("The scan's faces are so long and narrow that more than " + std::to_string(most) +
             " vertices would be needed to split them. Look for a vertex far from the others, or "
             "scan the grain again with more vertices.");
    }
    if (ends.size() % splits_a_report == 0) execution.report(0.0, "Splitting the scan's faces");
    const auto v = static_cast<std::int32_t>(mesh.points.size());
    const auto free = static_cast<std::int32_t>(mesh.triangles.size());
    mesh.points.push_back(0.5 * (mesh.points[from] + mesh.points[to]));
    mesh.first.push_back(-1);
    mesh.degrees.push_back(0);
    mesh.triangles.resize(mesh.triangles.size() + 2);
    mesh.opposite.resize(mesh.opposite.size() + 6, -1);
    mesh.put_on_edge(v, half_edge, {free, free + 1});
    ends.push_back({from, to});
    mesh.around(v, [&](std::int32_t h) {
      enter(h);
      enter(next_half_edge(h));
    });
  }
  return ends;
}

}  // namespace

SplitScan split_long_edges(EditMesh& mesh, double length, std::size_t most,
                           const Execution& execution) {
  std::vector<Vector3> normals = vertex_normals(mesh.points, mesh.triangles);
  for (const auto& [a, b] : split(mesh, length, most, execution)) {
    const Vector3 sum = normals[a] + normals[b];
    const double size = sum.norm();
    normals.push_back(size > 0.0 ? Vector3(sum / size) : sum);
  }
  SplitScan ordered;
  ordered.normals.reserve(normals.size());
  for (const std::int32_t v : order_in_space(mesh.points, mesh.triangles)) {
    ordered.normals.push_back(normals[v]);
  }
  mesh.link(execution);
  ordered.mesh = {mesh.points, mesh.triangles};
  return ordered;
}

namespace {

constexpr int bits_a_coordinate = 16;

/// Puts two zeros between the bits of a number below 2^16.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 16) & 0x0000FF0000FFULL;
  x = (x | x << 8) & 0x00F00F00F00FULL;
  x = (x | x << 4) & 0x0C30C30C30C3ULL;
  return (x | x << 2) & 0x249249249249ULL;
}

}  // namespace

std::vector<std::int32_t> space_order(const std::vector<Vector3>& points) {
  const Eigen::AlignedBox3d box = box_of(points);
  const double extent = box.sizes().maxCoeff();
  const double scale = extent > 0.0 ? ((1 << bits_a_coordinate) - 1) / extent : 0.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 at = scale * (points[i] - box.min());
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key |= spread_bits(static_cast<std::uint64_t>(at[k])) << k;
    keys[i] = {key, static_cast<std::int32_t>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = keys[i].second;
  return order;
}

std::vector<std::int32_t> order_in_space(std::vector<Vector3>& points,
                                         std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> order = space_order(points);
  std::vector<std::int32_t> numbers(points.size());
  std::vector<Vector3> ordered(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    ordered[i] = points[order[i]];
    numbers[order[i]] = static_cast<std::int32_t>(i);
  }
  points = std::move(ordered);
  for (Triangle& t : triangles) t = {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
  const auto first = [](const Triangle& t) { return std::min({t[0], t[1], t[2]}); };
  std::stable_sort(triangles.begin(), triangles.end(),
                   [&](const Triangle& a, const Triangle& b) { return first(a) < first(b); });
  return order;
}

}  // namespace wscvt
