// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/half_edges.h"

#include "wscvt/base/counting_sort.h"

namespace wscvt {

HalfEdges link_half_edges(const std::vector<Triangle>& triangles, std::size_t vertices,
                          const Execution& execution) {
  const std::size_t count = 3 * triangles.size();
  const Groups outgoing = counting_sort(
      count, vertices, [&](std::size_t h, const auto& visit) { visit(triangles[h / 3][h % 3]); });
  HalfEdges result;
  result.opposite.assign(count, -1);
  result.first.assign(vertices, -1);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (outgoing.begin(v) != outgoing.end(v)) result.first[v] = *outgoing.begin(v);
  }
  const auto opposite_of = [&](std::int32_t h) {
    const std::int32_t from = origin_of(triangles, h);
    const std::int32_t to = target_of(triangles, h);
    // The opposite is among the half-edges that leave `to` and among the half-edges that reach
    // `from`. Search the shorter list, because the hub of a large fan would need quadratic time.
    std::int32_t found = -1;
    if (outgoing.size(to) <= outgoing.size(from)) {
      for (auto other = outgoing.begin(to); other != outgoing.end(to); ++other) {
        if (target_of(triangles, *other) == from) found = *other;
      }
    } else {
      for (auto next = outgoing.begin(from); next != outgoing.end(from); ++next) {
        const std::int32_t reaching = previous_half_edge(*next);
        if (origin_of(triangles, reaching) == to) found = reaching;
      }
    }
    return found;
  };
  constexpr std::size_t block_size = 16384;
  execution.parallel_for(count, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h) {
      result.opposite[h] = opposite_of(static_cast<std::int32_t>(h));
    }
  });
  return result;
}

void flip_edge(std::int32_t half_edge, std::vector<Triangle>& triangles,
               std::vector<std::int32_t>& opposite) {
  const std::int32_t other = opposite[index(half_edge)];
  const std::int32_t t = 3 * static_cast<std::int32_t>(face_of(half_edge));
  const std::int32_t u = 3 * static_cast<std::int32_t>(face_of(other));
  const std::int32_t a = origin_of(triangles, half_edge);
  const std::int32_t b = origin_of(triangles, other);
  const std::int32_t c = origin_of(triangles, previous_half_edge(half_edge));
  const std::int32_t d = origin_of(triangles, previous_half_edge(other));
  const std::int32_t beyond_bc = opposite[index(next_half_edge(half_edge))];
  const std::int32_t beyond_ca = opposite[index(previous_half_edge(half_edge))];
  const std::int32_t beyond_ad = opposite[index(next_half_edge(other))];
  const std::int32_t beyond_db = opposite[index(previous_half_edge(other))];
  triangles[face_of(t)] = {c, a, d};
  triangles[face_of(u)] = {d, b, c};
  const auto link = [&](std::int32_t h, std::int32_t g) {
    opposite[index(h)] = g;
    if (g >= 0) opposite[index(g)] = h;
  };
  link(t, beyond_ca);
  link(t + 1, beyond_ad);
  link(u, beyond_db);
  link(u + 1, beyond_bc);
  link(t + 2, u + 2);
}

}  // namespace wscvt
