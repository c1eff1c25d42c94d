// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/edge_rings.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/half_edges.h"

namespace wscvt {

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
