// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/half_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "wscvt/base/counting_sort.h"

namespace wscvt {

namespace {

/// A half-edge among those of one lower vertex.
struct Link {
  std::int32_t higher;  ///< its other vertex
  std::int32_t half_edge;
  bool from_lower;

  bool operator<(const Link& other) const {
    return higher != other.higher ? higher < other.higher : half_edge < other.half_edge;
  }
};

}  // namespace

// A counting sort by the lower vertex leaves about three half-edges in a bucket, so every triangle
// is read twice for its links. To look for each opposite among the half-edges that leave its origin
// takes twice the time.
HalfEdges link_half_edges(const std::vector<Triangle>& triangles, std::size_t vertices,
                          const Execution& execution) {
  const std::size_t count = 3 * triangles.size();
  const Groups buckets = counting_sort(count, vertices, [&](std::size_t h, const auto& visit) {
    const Triangle& t = triangles[h / 3];
    visit(index(std::min(t[h % 3], t[following(h % 3)])));
  });
  HalfEdges result;
  result.opposite.assign(count, -1);
  result.first.assign(vertices, -1);
  for (std::size_t h = count; h-- > 0;) {
    result.first[index(triangles[h / 3][h % 3])] = static_cast<std::int32_t>(h);
  }
  constexpr std::size_t block_size = 16384;
  // Each half-edge is in one bucket, so no two blocks write to one entry.
  execution.parallel_for(vertices, block_size, [&](std::size_t begin, std::size_t end) {
    std::vector<Link> bucket;
    for (std::size_t v = begin; v < end; ++v) {
      bucket.clear();
      for (auto h = buckets.begin(v); h != buckets.end(v); ++h) {
        const std::int32_t from = origin_of(triangles, *h);
        const std::int32_t to = target_of(triangles, *h);
        bucket.push_back({std::max(from, to), *h, from <= to});
      }
      std::sort(bucket.begin(), bucket.end());
      for (auto first = bucket.begin(); first != bucket.end();) {
        auto last = first;
        // The highest of each direction; a loop is its own opposite.
        std::array<std::int32_t, 2> highest = {-1, -1};
        for (; last != bucket.end() && last->higher == first->higher; ++last) {
          highest[last->from_lower ? 0 : 1] = last->half_edge;
        }
        const bool is_loop = index(first->higher) == v;
        for (; first != last; ++first) {
          result.opposite[index(first->half_edge)] = highest[first->from_lower && !is_loop ? 1 : 0];
        }
      }
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

namespace {

/// Large enough that the start of a block costs little.
constexpr std::size_t ring_block = 16384;

}  // namespace

std::vector<std::int32_t> edge_rings(const IndexedMesh& mesh, const Execution& execution) {
  const std::size_t vertices = mesh.points.size();
  const std::vector<Triangle>& triangles = mesh.triangles;
  // Most of the time is the sort of all half-edges by their two vertices. A counting sort by the
  // lower vertex leaves buckets of about three, which are sorted in parallel by the higher vertex.
  // Without a hash table the order is equal on any machine, and memory is read nearly in order.
  const Groups buckets =
      counting_sort(3 * triangles.size(), vertices, [&](std::size_t h, const auto& visit) {
        const Triangle& t = triangles[h / 3];
        visit(index(std::min(t[h % 3], t[following(h % 3)])));
      });
  std::vector<std::int32_t> rings(3 * triangles.size());
  // Each half-edge is in one bucket, so no two blocks write to one entry.
  execution.parallel_for(vertices, ring_block, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<std::int32_t, std::int32_t>> bucket;  // higher vertex, half-edge
    for (std::size_t v = begin; v < end; ++v) {
      bucket.clear();
      for (auto h = buckets.begin(v); h != buckets.end(v); ++h) {
        const Triangle& t = triangles[face_of(*h)];
        bucket.emplace_back(std::max(t[corner_of(*h)], t[following(corner_of(*h))]), *h);
      }
      std::sort(bucket.begin(), bucket.end());
      for (std::size_t first = 0; first < bucket.size();) {
        std::size_t last = first;
        while (last + 1 < bucket.size() && bucket[last + 1].first == bucket[first].first) {
          rings[index(bucket[last].second)] = bucket[last + 1].second;
          ++last;
        }
        rings[index(bucket[last].second)] = bucket[first].second;
        first = last + 1;
      }
    }
  });
  return rings;
}

}  // namespace wscvt
