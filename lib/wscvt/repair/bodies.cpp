// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/bodies.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/repair/components.h"
#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/degenerate_faces.h"
#include "wscvt/repair/edge_rings.h"
#include "wscvt/repair/enclosure.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/repair/usable_scan.h"
#include "wscvt/repair/weld.h"

namespace wscvt {

namespace {

/// A part of the mesh connected through edges.
struct Part {
  IndexedMesh mesh;  ///< outward
  Box box;
  double volume = 0.0;  ///< if closed, else 0
  std::size_t boundary_edges = 0;
  std::vector<std::size_t> holders;  ///< closed parts that contain it
};

void weld(IndexedMesh& mesh, const Execution& execution) {
  const Box box = box_of_faces(mesh, execution);
  check_scan_size(box.high - box.low);
  const double tolerance = MeshCheckOptions().weld_tolerance * (box.high - box.low).norm();
  drop_degenerate_faces(mesh, find_equal_points(mesh.points, box, tolerance, execution).first);
  if (!mesh.triangles.empty()) return;
  refuse(
      "All faces of the mesh have two corners in one place, so it has no body. Load closed "
      "surfaces.");
}

/// Returns the parts as separate meshes, with vertices in the order of their first use by a face.
std::vector<Part> parts_of(const IndexedMesh& mesh, const Components& components,
                           const Execution& execution) {
  std::vector<Part> parts(components.list.size());
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::vector<std::int32_t> part_of_vertex(mesh.points.size(), -1);
  std::vector<std::vector<std::int32_t>> faces(parts.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    faces[index(components.of_face[f])].push_back(static_cast<std::int32_t>(f));
  }
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const Component& component = components.list[c];
    Part& part = parts[c];
    part.boundary_edges = component.boundary_edges;
    const bool is_closed = component.boundary_edges == 0 && component.orientable;
    if (is_closed) part.volume = std::abs(component.volume);
    for (const std::int32_t f : faces[c]) {
      Triangle t = mesh.triangles[index(f)];
      const bool inside_out = is_closed && component.volume < 0.0;
      if ((components.turned[index(f)] != 0) != inside_out) std::swap(t[1], t[2]);
      for (std::int32_t& v : t) {
        const std::size_t vertex = index(v);
        // Parts may share a vertex.
        if (part_of_vertex[vertex] != static_cast<std::int32_t>(c)) {
          part_of_vertex[vertex] = static_cast<std::int32_t>(c);
          number[vertex] = static_cast<std::int32_t>(part.mesh.points.size());
          part.mesh.points.push_back(mesh.points[vertex]);
        }
        v = number[vertex];
      }
      part.mesh.triangles.push_back(t);
    }
    part.box = box_of_faces(part.mesh, execution);
  }
  return parts;
}

bool holds(const Box& outer, const Box& inner) {
  return (outer.low.array() <= inner.low.array()).all() &&
         (outer.high.array() >= inner.high.array()).all();
}

/// Finds for every closed part the parts that contain it. Tests the centres of some faces spread
/// over it, because touching parts may share corners, and parts that intersect contain only some of
/// each other's faces.
void find_holders(std::vector<Part>& parts, const Execution& execution) {
  constexpr std::size_t most_asked = 16;
  for (std::size_t outer = 0; outer < parts.size(); ++outer) {
    execution.report(static_cast<double>(outer) / static_cast<double>(parts.size()),
                     "Splitting the mesh");
    if (parts[outer].volume == 0.0) continue;
    std::vector<std::size_t> inner_of_point;
    std::vector<Vector3> points;
    for (std::size_t inner = 0; inner < parts.size(); ++inner) {
      const Part& part = parts[inner];
      if (inner == outer || part.volume == 0.0 || part.volume >= parts[outer].volume ||
          !holds(parts[outer].box, part.box)) {
        continue;
      }
      const std::size_t faces = part.mesh.triangles.size();
      const std::size_t asked = std::min(faces, most_asked);
      for (std::size_t k = 0; k < asked; ++k) {
        const Triangle& t = part.mesh.triangles[k * faces / asked];
        points.emplace_back((part.mesh.points[index(t[0])] + part.mesh.points[index(t[1])] +
                             part.mesh.points[index(t[2])]) /
                            3.0);
        inner_of_point.push_back(inner);
      }
    }
    if (points.empty()) continue;
    const std::vector<char> inside = are_inside(parts[outer].mesh, points, execution);
    for (std::size_t k = 0; k < points.size();) {
      const std::size_t inner = inner_of_point[k];
      bool is_inside = true;
      for (; k < points.size() && inner_of_point[k] == inner; ++k) {
        is_inside = is_inside && inside[k] != 0;
      }
      if (is_inside) parts[inner].holders.push_back(outer);
    }
  }
}

/// Adds a pore, turned inward.
void add_pore(Part& pore, MeshBody& body) {
  const auto first = static_cast<std::int32_t>(body.mesh.points.size());
  body.mesh.points.insert(body.mesh.points.end(), pore.mesh.points.begin(), pore.mesh.points.end());
  for (const Triangle& t : pore.mesh.triangles) {
    body.mesh.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
  }
  ++body.pores;
  body.pore_volume += pore.volume;
}

}  // namespace

std::vector<MeshBody> split_bodies(IndexedMesh mesh, const Execution& execution) {
  keep_usable_faces(mesh, execution);
  weld(mesh, execution);
  const Components components = find_components(mesh, edge_rings(mesh, execution), execution);
  std::vector<Part> parts = parts_of(mesh, components, execution);
  mesh = IndexedMesh();
  find_holders(parts, execution);
  std::vector<MeshBody> bodies;
  std::vector<std::size_t> body_of(parts.size(), 0);
  // An odd number of parts contains a pore.
  for (std::size_t c = 0; c < parts.size(); ++c) {
    Part& part = parts[c];
    if (part.holders.size() % 2 == 1) continue;
    body_of[c] = bodies.size();
    MeshBody body;
    body.mesh = std::move(part.mesh);
    body.volume = part.volume;
    body.boundary_edges = part.boundary_edges;
    bodies.push_back(std::move(body));
  }
  for (Part& part : parts) {
    if (part.holders.size() % 2 == 0) continue;
    const std::size_t nearest = *std::min_element(
        part.holders.begin(), part.holders.end(),
        [&](std::size_t a, std::size_t b) { return parts[a].volume < parts[b].volume; });
    add_pore(part, bodies[body_of[nearest]]);
  }
  return bodies;
}

}  // namespace wscvt
