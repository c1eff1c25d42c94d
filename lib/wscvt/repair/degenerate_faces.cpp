// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/repair_steps.h"

namespace wscvt {

DegenerateFaces drop_degenerate_faces(IndexedMesh& mesh, const std::vector<std::int32_t>& first) {
  // Renumber, mark and drop in one pass, because three passes would read the largest array three
  // times.
  std::vector<char> used(mesh.points.size(), 0);
  std::size_t kept = 0;
  for (const Triangle& original : mesh.triangles) {
    Triangle t = original;
    for (std::int32_t& v : t) {
      if (!first.empty()) v = first[index(v)];
      used[index(v)] = 1;
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    mesh.triangles[kept++] = t;
  }
  DegenerateFaces result;
  result.faces = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  result.used_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  return result;
}

DuplicateFaces drop_duplicate_faces(IndexedMesh& mesh, const std::vector<std::int32_t>& rings) {
  using Edge = std::pair<std::int32_t, std::int32_t>;
  struct Candidate {
    Triangle key;  // the vertices in ascending order
    std::int32_t face;
    bool operator<(const Candidate& other) const {
      return key != other.key ? key < other.key : face < other.face;
    }
  };
  // Two faces with equal vertices share their edges with each other and, unless they are a separate
  // body, with other faces. A clean scan has no candidates and is not sorted.
  std::vector<Candidate> candidates;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t h = 3 * f; h < 3 * f + 3; ++h) {
      if (index(rings[index(rings[h])]) == h) continue;
      Triangle key = mesh.triangles[f];
      std::sort(key.begin(), key.end());
      candidates.push_back({key, static_cast<std::int32_t>(f)});
      break;
    }
  }
  if (candidates.empty()) return {};
  std::sort(candidates.begin(), candidates.end());

  // Contains every edge once per different face on it.
  std::vector<Edge> edges;
  const auto edges_of = [](const Triangle& key) {
    return std::array<Edge, 3>{Edge{key[0], key[1]}, Edge{key[1], key[2]}, Edge{key[0], key[2]}};
  };
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0 && candidates[i].key == candidates[i - 1].key) continue;
    for (const Edge& edge : edges_of(candidates[i].key)) edges.push_back(edge);
  }
  std::sort(edges.begin(), edges.end());
  const auto needs_face = [&](const Edge& edge) {
    const auto range = std::equal_range(edges.begin(), edges.end(), edge);
    return (range.second - range.first) % 2 == 0;  // an odd number besides this face
  };
  std::vector<char> dropped(mesh.triangles.size(), 0);
  DuplicateFaces result;
  for (std::size_t first = 0; first < candidates.size();) {
    std::size_t last = first + 1;
    while (last < candidates.size() && candidates[last].key == candidates[first].key) ++last;
    if (last - first > 1) {
      const std::array<Edge, 3> sides = edges_of(candidates[first].key);
      const bool keep = std::any_of(sides.begin(), sides.end(), needs_face);
      const double area = triangle_area(mesh, candidates[first].key);
      for (std::size_t i = first + (keep ? 1 : 0); i < last; ++i) {
        dropped[index(candidates[i].face)] = 1;
        ++(keep ? result.copies : result.folded);
        (keep ? result.copied_area : result.folded_area) += area;
      }
    }
    first = last;
  }
  if (result.copies + result.folded == 0) return result;
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!dropped[f]) mesh.triangles[kept++] = mesh.triangles[f];
  }
  mesh.triangles.resize(kept);
  return result;
}

}  // namespace wscvt
