// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/edit_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wscvt {

EditMesh::EditMesh(std::vector<Vector3> mesh_points, std::vector<Triangle> mesh_triangles,
                   const Execution& execution)
    : points(std::move(mesh_points)), triangles(std::move(mesh_triangles)) {
  link(execution);
}

void EditMesh::link(const Execution& execution) {
  HalfEdges links = link_half_edges(triangles, points.size(), execution);
  opposite = std::move(links.opposite);
  first = std::move(links.first);
  degrees.assign(points.size(), 0);
  for (const Triangle& t : triangles) {
    for (const std::int32_t v : t) ++degrees[v];
  }
}

bool EditMesh::joined(std::int32_t a, std::int32_t b) const {
  std::int32_t h = first[a];
  do {
    if (target(h) == b) return true;
    h = opposite[previous_half_edge(h)];
  } while (h != first[a]);
  return false;
}

void EditMesh::flip(std::int32_t h) {
  const std::int32_t g = opposite[h];
  const std::int32_t t = 3 * static_cast<std::int32_t>(face_of(h));
  const std::int32_t u = 3 * static_cast<std::int32_t>(face_of(g));
  const std::int32_t a = origin(h);
  const std::int32_t b = origin(g);
  const std::int32_t c = apex(h);
  const std::int32_t d = apex(g);
  flip_edge(h, triangles, opposite);
  first[c] = t;
  first[a] = t + 1;
  first[d] = u;
  first[b] = u + 1;
  --degrees[a];
  --degrees[b];
  ++degrees[c];
  ++degrees[d];
}

std::array<std::int32_t, 2> EditMesh::collapse(std::int32_t h) {
  const std::int32_t g = opposite[h];
  const std::int32_t v = origin(h);
  const std::int32_t w = target(h);
  const std::int32_t degree = degrees[v];
  // From here on the half-edges from v start at w; the half-edges of the two triangles are free.
  std::int32_t leaving = h;
  do {
    const std::int32_t next = opposite[previous_half_edge(leaving)];
    triangles[face_of(leaving)][corner_of(leaving)] = w;
    leaving = next;
  } while (leaving != h);
  for (const std::int32_t side : {h, g}) {
    const std::int32_t beyond_next = opposite[next_half_edge(side)];
    const std::int32_t beyond_previous = opposite[previous_half_edge(side)];
    const std::int32_t y = apex(side);
    pair(beyond_next, beyond_previous);
    first[y] = origin(beyond_next) == y ? beyond_next : beyond_previous;
    first[w] = origin(beyond_next) == w ? beyond_next : beyond_previous;
    --degrees[y];
  }
  degrees[w] += degree - 4;
  degrees[v] = 0;
  first[v] = -1;
  return {static_cast<std::int32_t>(face_of(h)), static_cast<std::int32_t>(face_of(g))};
}

void EditMesh::put_on_edge(std::int32_t v, std::int32_t h,
                           const std::array<std::int32_t, 2>& free) {
  const std::int32_t g = opposite[h];
  const std::int32_t a = origin(h);
  const std::int32_t b = origin(g);
  const std::int32_t c = apex(h);
  const std::int32_t d = apex(g);
  const std::int32_t beyond_bc = opposite[next_half_edge(h)];
  const std::int32_t beyond_ca = opposite[previous_half_edge(h)];
  const std::int32_t beyond_ad = opposite[next_half_edge(g)];
  const std::int32_t beyond_db = opposite[previous_half_edge(g)];
  const auto t = static_cast<std::int32_t>(face_of(h));
  const auto u = static_cast<std::int32_t>(face_of(g));
  const std::int32_t p = free[0];
  const std::int32_t q = free[1];
  triangles[t] = {c, a, v};
  triangles[p] = {c, v, b};
  triangles[u] = {d, v, a};
  triangles[q] = {d, b, v};
  pair(3 * t, beyond_ca);
  pair(3 * t + 1, 3 * u + 1);
  pair(3 * t + 2, 3 * p);
  pair(3 * p + 1, 3 * q + 1);
  pair(3 * p + 2, beyond_bc);
  pair(3 * u, 3 * q + 2);
  pair(3 * u + 2, beyond_ad);
  pair(3 * q, beyond_db);
  first[v] = 3 * t + 2;
  first[a] = 3 * t + 1;
  first[b] = 3 * p + 2;
  first[c] = 3 * t;
  first[d] = 3 * u;
  degrees[v] = 4;
  ++degrees[c];
  ++degrees[d];
}

double mean_edge_length(const EditMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += (mesh.points[a] - mesh.points[b]).norm() + (mesh.points[b] - mesh.points[c]).norm() +
           (mesh.points[c] - mesh.points[a]).norm();
  }
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

double mean_edge_ratio(const EditMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto [shortest, longest] = std::minmax({(mesh.points[a] - mesh.points[b]).squaredNorm(),
                                                  (mesh.points[b] - mesh.points[c]).squaredNorm(),
                                                  (mesh.points[c] - mesh.points[a]).squaredNorm()});
    sum += std::sqrt(longest / std::max(shortest, 1e-300));
  }
  return sum / static_cast<double>(mesh.triangles.size());
}

}  // namespace wscvt
