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
  const EdgeSides e = sides(h);
  flip_edge(h, triangles, opposite);
  first[e.c] = 3 * e.t;
  first[e.a] = 3 * e.t + 1;
  first[e.d] = 3 * e.u;
  first[e.b] = 3 * e.u + 1;
  --degrees[e.a];
  --degrees[e.b];
  ++degrees[e.c];
  ++degrees[e.d];
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
  const auto [same, g, t, u, a, b, c, d] = sides(h);
  const std::int32_t beyond_bc = opposite[next_half_edge(h)];
  const std::int32_t beyond_ca = opposite[previous_half_edge(h)];
  const std::int32_t beyond_ad = opposite[next_half_edge(g)];
  const std::int32_t beyond_db = opposite[previous_half_edge(g)];
  const auto [p, q] = free;
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

namespace {

/// Edges below this cosine of their normals are sharp: 73 degrees.
constexpr double sharp_bend = 0.3;
/// A flip from or to a sharp edge must lower the sum of turns by this much. At a rim, Delaunay's
/// rule would cut a long edge of the rim by an edge from sheet to sheet, which leaves a notch, or
/// keep one. A quarter or 2.5 times as much changes 2 %.
constexpr double least_fall = 0.2;
/// Such a flip makes no angle below 15 degrees.
constexpr double sharpest_rim_corner = 0.966;

/// The edge ab of the triangles abc and bad, which would become cd, with unit normals.
struct Flip {
  std::int32_t h, g;
  Vector3 abc, bad;
  Vector3 cad, dbc;
};

/// Returns how much less the faces turn after a flip, over its edge and the four about it.
double fall_of_turns(const EditMesh& mesh, const Flip& f) {
  const auto beyond = [&](std::int32_t h) {
    const Vector3 n = mesh.normal(face_of(mesh.opposite[h]));
    return Vector3(n / (n.norm() + 1e-300));
  };
  const Vector3 bc = beyond(next_half_edge(f.h));
  const Vector3 ca = beyond(previous_half_edge(f.h));
  const Vector3 ad = beyond(next_half_edge(f.g));
  const Vector3 db = beyond(previous_half_edge(f.g));
  return f.cad.dot(f.dbc) + f.cad.dot(ca + ad) + f.dbc.dot(db + bc) - f.abc.dot(f.bad) -
         f.abc.dot(bc + ca) - f.bad.dot(ad + db);
}

bool try_flip(EditMesh& mesh, const std::vector<Vector3>& outward, std::int32_t h) {
  const auto [same, g, t, u, a, b, c, d] = mesh.sides(h);
  const Vector3& pc = mesh.points[c];
  const Vector3& pd = mesh.points[d];
  const Vector3 ca = mesh.points[a] - pc;
  const Vector3 cb = mesh.points[b] - pc;
  const Vector3 da = mesh.points[a] - pd;
  const Vector3 db = mesh.points[b] - pd;
  Vector3 m1 = ca.cross(cb);
  Vector3 m2 = db.cross(da);
  Vector3 n1 = ca.cross(pd - pc);
  Vector3 n2 = (pd - pc).cross(cb);
  const double at_c = ca.dot(cb);
  const double at_d = da.dot(db);
  // Most edges are flat and opposite to acute angles, which is seen without roots.
  const double bend = m1.dot(m2);
  if (at_c >= 0.0 && at_d >= 0.0 && bend > 0.0 && n1.dot(n2) > 0.0 &&
      bend * bend > sharp_bend * sharp_bend * m1.squaredNorm() * m2.squaredNorm()) {
    return false;
  }
  const double s1 = m1.norm();
  const double s2 = m2.norm();
  // The sine of the sum of the angles at c and d, times the edges' lengths.
  const double sine = at_c * s2 + at_d * s1;
  const bool is_delaunay = sine > -1e-6 * (s1 * s2 + 1e-300);
  if (mesh.degrees[a] <= 3 || mesh.degrees[b] <= 3 || c == d) return false;
  if (is_delaunay && n1.dot(n2) > 0.0 && bend > sharp_bend * s1 * s2) return false;
  const double a1 = n1.norm();
  const double a2 = n2.norm();
  if (a1 < 1e-300 || a2 < 1e-300) return false;
  m1 /= s1 + 1e-300;
  m2 /= s2 + 1e-300;
  n1 /= a1;
  n2 /= a2;
  if (std::min(m1.dot(m2), n1.dot(n2)) < sharp_bend) {
    if (std::max(largest_corner_cosine(pc, mesh.points[a], pd),
                 largest_corner_cosine(pc, pd, mesh.points[b])) > sharpest_rim_corner ||
        fall_of_turns(mesh, {h, g, m1, m2, n1, n2}) < least_fall) {
      return false;
    }
  } else {
    if (is_delaunay) return false;
    const Vector3 ab = outward[a] + outward[b];
    const Vector3 cd = outward[c] + outward[d];
    const double before = std::min(cosine_to(m1, ab + outward[c]), cosine_to(m2, ab + outward[d]));
    const double after = std::min(cosine_to(n1, cd + outward[a]), cosine_to(n2, cd + outward[b]));
    if (after < std::min(before, least_agreement)) return false;
  }
  if (mesh.joined(c, d)) return false;
  mesh.flip(h);
  return true;
}

}  // namespace

int flip_to_delaunay(EditMesh& mesh, const std::vector<Vector3>& outward) {
  int flipped = 0;
  const auto faces = static_cast<std::int32_t>(mesh.triangles.size());
  for (std::int32_t t = 0; t < faces; ++t) {
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (static_cast<std::int32_t>(face_of(mesh.opposite[h])) < t) continue;
      if (!try_flip(mesh, outward, h)) continue;
      ++flipped;
      break;  // the next pass does the triangle's other edges
    }
  }
  return flipped;
}

}  // namespace wscvt
