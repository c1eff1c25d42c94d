// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/edge_rings.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "wscvt/scan/half_edges.h"

namespace wscvt {

using namespace half_edges;

std::vector<std::int32_t> edge_rings(const IndexedMesh& mesh, const Execution& execution) {
  const std::size_t vertices = mesh.points.size();
  const std::vector<Triangle>& triangles = mesh.triangles;
  // Sorting all half-edges by both their vertices is what the stage costs. A counting sort by the
  // lower vertex leaves buckets of about three, which are sorted in parallel by the higher one: no
  // hash table, hence the same order on any machine, and memory is read nearly in its order.
  // `starts[v]` is where the bucket of vertex v begins in `half_edges`. It is counted two places
  // further on, so that the filling below, which moves `starts[v + 1]` from the beginning of bucket
  // v to its end, leaves every entry in its own place.
  std::vector<std::int32_t> starts(vertices + 2, 0);
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++starts[index(std::min(t[k], t[following(k)])) + 2];
  }
  for (std::size_t v = 2; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<std::int32_t> half_edges(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& place = starts[index(std::min(t[k], t[following(k)])) + 1];
      half_edges[index(place++)] = static_cast<std::int32_t>(3 * f + k);
    }
  }
  std::vector<std::int32_t> rings(half_edges.size());
  // Each half-edge lies in one bucket, so no two blocks write to the same place.
  execution.parallel_for(vertices, block_size, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<std::int32_t, std::int32_t>> bucket;  // higher vertex, half-edge
    for (std::size_t v = begin; v < end; ++v) {
      bucket.clear();
      for (std::int32_t i = starts[v]; i < starts[v + 1]; ++i) {
        const std::int32_t h = half_edges[index(i)];
        const Triangle& t = triangles[face_of(h)];
        bucket.emplace_back(std::max(t[corner_of(h)], t[following(corner_of(h))]), h);
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
