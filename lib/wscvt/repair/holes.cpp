// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/repair_steps.h"

namespace wscvt {

namespace {

using Rim = std::vector<std::int32_t>;  // vertices, with the hole's faces counter-clockwise
using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge_of(std::int32_t a, std::int32_t b) { return std::minmax(a, b); }

/// Returns the vertex after the i-th along the rim.
std::int32_t after(const Rim& rim, std::size_t i) { return rim[i + 1 < rim.size() ? i + 1 : 0]; }

/// Cuts a closed walk that passes vertices more than once into walks that do not.
void append_simple(const Rim& walk, std::vector<Rim>& rims) {
  Rim open;
  std::map<std::int32_t, std::size_t> place;  // of the vertices in `open`
  for (const std::int32_t v : walk) {
    const auto at = place.find(v);
    if (at != place.end()) {
      const auto first = open.begin() + static_cast<std::ptrdiff_t>(at->second);
      rims.emplace_back(first, open.end());
      for (auto i = first; i != open.end(); ++i) place.erase(*i);
      open.erase(first, open.end());
    }
    place[v] = open.size();
    open.push_back(v);
  }
  rims.push_back(std::move(open));
}

std::vector<Rim> find_rims(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings) {
  std::vector<Rim> rims;
  std::vector<char> seen(rings.size(), 0);
  for (std::size_t start = 0; start < rings.size(); ++start) {
    if (index(rings[start]) != start || seen[start]) continue;
    Rim walk;
    for (std::size_t h = start; !seen[h];) {
      seen[h] = 1;
      walk.push_back(mesh.triangles[h / 3][h % 3]);
      // Turning about the end of this edge, within its fan of faces, finds the next boundary edge.
      // If several fans meet in a vertex, each keeps its own rim.
      h = h - h % 3 + following(h % 3);
      while (index(rings[h]) != h) {
        const std::size_t other = index(rings[h]);
        h = other - other % 3 + following(other % 3);
      }
    }
    std::reverse(walk.begin(), walk.end());  // the hole's faces have the opposite direction
    append_simple(walk, rims);
  }
  return rims;
}

/// Returns triangles between the rim's vertices, as indices into the rim; empty if none fit.
std::vector<Triangle> triangulate(const IndexedMesh& mesh, const Rim& rim,
                                  const std::set<Edge>& taken) {
  // CGAL's method for large rims uses a Delaunay triangulation in the order of addresses, so two
  // runs may differ. Its plain method (Barequet and Sharir 1995) always gives the same triangles,
  // but its time grows with the cube of the rim: 0.1 s for 200 vertices.
  constexpr std::size_t largest_rim = 200;
  if (rim.size() == 3) return {{0, 1, 2}};
  if (rim.size() > largest_rim) return {};
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
  for (const std::int32_t v : rim) {
    const Vector3& p = mesh.points[index(v)];
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<CGAL::Triple<int, int, int>> found;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
      points, std::back_inserter(found),
      CGAL::parameters::use_delaunay_triangulation(false).use_2d_constrained_delaunay_triangulation(
          false));
  if (found.size() + 2 != rim.size()) return {};
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : found) {
    Triangle t = {a, b, c};
    std::sort(t.begin(), t.end());  // counter-clockwise like the rim, for any order from CGAL
    triangles.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t i = t[k];
      const std::int32_t j = t[following(k)];
      const bool on_rim =
          std::abs(i - j) == 1 || std::abs(i - j) + 1 == static_cast<int>(rim.size());
      if (!on_rim && taken.count(edge_of(rim[index(i)], rim[index(j)])) > 0) return {};
    }
  }
  return triangles;
}

/// Returns the edges between any two vertices of rims.
std::set<Edge> edges_between(const IndexedMesh& mesh, const std::vector<Rim>& rims) {
  std::vector<char> on_rim(mesh.points.size(), 0);
  for (const Rim& rim : rims) {
    for (const std::int32_t v : rim) on_rim[index(v)] = 1;
  }
  std::set<Edge> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k];
      const std::int32_t b = t[following(k)];
      if (on_rim[index(a)] && on_rim[index(b)]) edges.insert(edge_of(a, b));
    }
  }
  return edges;
}

/// Returns the triangles that fill a rim. If its vertices allow no triangles, adds a vertex at its
/// centroid.
std::vector<Triangle> filling(IndexedMesh& mesh, const Rim& rim, const std::set<Edge>& taken) {
  std::vector<Triangle> faces = triangulate(mesh, rim, taken);
  if (!faces.empty()) {
    for (Triangle& t : faces) t = {rim[index(t[0])], rim[index(t[1])], rim[index(t[2])]};
    return faces;
  }
  Vector3 centroid = Vector3::Zero();
  for (const std::int32_t v : rim) centroid += mesh.points[index(v)] - mesh.points[index(rim[0])];
  centroid = mesh.points[index(rim[0])] + centroid / static_cast<double>(rim.size());
  const auto middle = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.push_back(centroid);
  for (std::size_t i = 0; i < rim.size(); ++i) faces.push_back({rim[i], after(rim, i), middle});
  return faces;
}

}  // namespace

FilledHoles fill_holes(IndexedMesh& mesh, const std::vector<std::int32_t>& rings) {
  FilledHoles result;
  const std::vector<Rim> rims = find_rims(mesh, rings);
  result.holes = rims.size();
  std::set<Edge> taken = edges_between(mesh, rims);
  for (const Rim& rim : rims) {
    double area = 0.0;
    for (const Triangle& face : filling(mesh, rim, taken)) {
      mesh.triangles.push_back(face);
      ++result.faces;
      area += triangle_area(mesh, face);
      for (std::size_t k = 0; k < 3; ++k) taken.insert(edge_of(face[k], face[following(k)]));
    }
    double length = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      length += (mesh.points[index(after(rim, i))] - mesh.points[index(rim[i])]).norm();
    }
    result.area += area;
    if (length > 0.0) result.widest = std::max(result.widest, 4.0 * area / length);
  }
  return result;
}

}  // namespace wscvt
