// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/half_edges.h"

#include "wscvt/base/counting_sort.h"

namespace wscvt {

HalfEdges link_half_edges(const std::vector<Triangle>& triangles, std::size_t vertices) {
  const std::size_t count = 3 * triangles.size();
  const Groups outgoing = counting_sort(
      count, vertices, [&](std::size_t h, const auto& visit) { visit(triangles[h / 3][h % 3]); });
  HalfEdges result;
  result.opposite.assign(count, -1);
  result.first.assign(vertices, -1);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (outgoing.begin(v) != outgoing.end(v)) result.first[v] = *outgoing.begin(v);
  }
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(count); ++h) {
    const std::int32_t from = origin_of(triangles, h);
    const std::int32_t to = target_of(triangles, h);
    // The other way round is among the half-edges that leave `to` and among those that reach
    // `from`. The shorter list is searched: the hub of a fan of thousands would cost their square.
    if (outgoing.size(to) <= outgoing.size(from)) {
      for (auto other = outgoing.begin(to); other != outgoing.end(to); ++other) {
        if (target_of(triangles, *other) == from) result.opposite[h] = *other;
      }
    } else {
      for (auto next = outgoing.begin(from); next != outgoing.end(from); ++next) {
        const std::int32_t reaching = previous_half_edge(*next);
        if (origin_of(triangles, reaching) == to) result.opposite[h] = reaching;
      }
    }
  }
  return result;
}

}  // namespace wscvt
