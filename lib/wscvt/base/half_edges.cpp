// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/half_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "wscvt/base/counting_sort.h"

namespace wscvt {

namespace {

/// The higher vertex of a half-edge, and the half-edge.
using Link = std::pair<std::int32_t, std::int32_t>;
using Links = std::vector<Link>::const_iterator;

/// Calls visit(lower vertex, first, last) with the links of the half-edges on each edge, which are
/// ascending. Edges of different lower vertices may be visited at the same time.
///
/// Most of the time is the sort of all half-edges by their two vertices. A counting sort by the
/// lower vertex leaves buckets of about three, which are sorted in parallel by the higher vertex.
/// Without a hash table the order is equal on any machine, and memory is read nearly in order. To
/// look for each opposite among the half-edges that leave its origin takes twice the time.
template <class Visit>
void visit_edges(const std::vector<Triangle>& triangles, std::size_t vertices,
                 const Execution& execution, const Visit& visit) {
  const Groups buckets =
      counting_sort(3 * triangles.size(), vertices, [&](std::size_t h, const auto& visit_group) {
        const Triangle& t = triangles[h / 3];
        visit_group(index(std::min(t[h % 3], t[following(h % 3)])));
      });
  execution.parallel_for(vertices, usual_block, [&](std::size_t begin, std::size_t end) {
    std::vector<Link> bucket;
    for (std::size_t v = begin; v < end; ++v) {
      bucket.clear();
      for (auto h = buckets.begin(v); h != buckets.end(v); ++h) {
        bucket.emplace_back(std::max(origin_of(triangles, *h), target_of(triangles, *h)), *h);
      }
      std::sort(bucket.begin(), bucket.end());
      for (Links first = bucket.begin(); first != bucket.end();) {
        Links last = first + 1;
        while (last != bucket.end() && last->first == first->first) ++last;
        visit(v, first, last);
        first = last;
      }
    }
  });
}

}  // namespace

HalfEdges link_half_edges(const std::vector<Triangle>& triangles, std::size_t vertices,
                          const Execution& execution) {
  const std::size_t count = 3 * triangles.size();
  HalfEdges result;
  result.opposite.assign(count, -1);
  result.first.assign(vertices, -1);
  for (std::size_t h = count; h-- > 0;) {
    result.first[index(triangles[h / 3][h % 3])] = static_cast<std::int32_t>(h);
  }
  visit_edges(triangles, vertices, execution, [&](std::size_t lower, Links first, Links last) {
    // The highest of each direction; a loop is its own opposite.
    const auto way_of = [&](std::int32_t h) {
      return index(origin_of(triangles, h)) == lower ? std::size_t{0} : std::size_t{1};
    };
    std::array<std::int32_t, 2> highest = {-1, -1};
    for (Links at = first; at != last; ++at) highest[way_of(at->second)] = at->second;
    const bool is_loop = index(first->first) == lower;
    for (Links at = first; at != last; ++at) {
      result.opposite[index(at->second)] = highest[is_loop ? 0 : 1 - way_of(at->second)];
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

void drop_unused_points(IndexedMesh& mesh) {
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) number[index(v)] = 0;
  }
  std::size_t kept = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<std::int32_t>(kept);
    mesh.points[kept++] = mesh.points[v];
  }
  if (kept == mesh.points.size()) return;
  mesh.points.resize(kept);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& v : t) v = number[index(v)];
  }
}

std::vector<std::int32_t> edge_rings(const IndexedMesh& mesh, const Execution& execution) {
  std::vector<std::int32_t> rings(3 * mesh.triangles.size());
  visit_edges(mesh.triangles, mesh.points.size(), execution,
              [&](std::size_t /*lower*/, Links first, Links last) {
                for (Links at = first; at != last; ++at) {
                  rings[index(at->second)] = (at + 1 == last ? first : at + 1)->second;
                }
              });
  return rings;
}

}  // namespace wscvt
