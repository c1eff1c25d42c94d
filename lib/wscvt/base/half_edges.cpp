// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/half_edges.h"

#include <numeric>

namespace wscvt {

HalfEdges link_half_edges(const std::vector<Triangle>& triangles, std::size_t vertices) {
  const std::size_t count = 3 * triangles.size();
  // Half-edges grouped by their origin.
  std::vector<std::int32_t> begin(vertices + 1, 0);
  for (const Triangle& t : triangles) {
    for (const std::int32_t v : t) ++begin[v + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::int32_t> outgoing(count);
  std::vector<std::int32_t> fill(begin.begin(), begin.end() - 1);
  for (std::size_t h = 0; h < count; ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    outgoing[fill[origin_of(triangles, half_edge)]++] = half_edge;
  }
  HalfEdges result;
  result.opposite.assign(count, -1);
  result.first.assign(vertices, -1);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (begin[v] < begin[v + 1]) result.first[v] = outgoing[begin[v]];
  }
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(count); ++h) {
    const std::int32_t from = origin_of(triangles, h);
    const std::int32_t to = target_of(triangles, h);
    // The other way round is among the half-edges that leave `to` and among those that reach
    // `from`. The shorter list is searched: the hub of a fan of thousands would cost their square.
    if (begin[to + 1] - begin[to] <= begin[from + 1] - begin[from]) {
      for (std::int32_t k = begin[to]; k < begin[to + 1]; ++k) {
        if (target_of(triangles, outgoing[k]) == from) result.opposite[h] = outgoing[k];
      }
    } else {
      for (std::int32_t k = begin[from]; k < begin[from + 1]; ++k) {
        const std::int32_t reaching = previous_half_edge(outgoing[k]);
        if (origin_of(triangles, reaching) == to) result.opposite[h] = reaching;
      }
    }
  }
  return result;
}

}  // namespace wscvt
