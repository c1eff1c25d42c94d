// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/convex/body_cut.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdint>
#include <exception>
#include <utility>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

using CutKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using CutMesh = CGAL::Surface_mesh<CutKernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

double mesh_volume(const IndexedMesh& mesh) {
  return mesh_sums(mesh.points, mesh.triangles, mesh.points.front(), Execution(1)).volume();
}

Triangle corners_of(const CutMesh& mesh, CutMesh::Face_index face) {
  Triangle triangle{};
  std::size_t corner = 0;
  for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) {
    triangle[corner++] = static_cast<std::int32_t>(static_cast<std::uint32_t>(vertex));
  }
  return triangle;
}

/// False where they are those of no manifold.
bool add_faces(const std::vector<Triangle>& triangles, CutMesh& mesh) {
  for (const Triangle& t : triangles) {
    const auto vertex = [&](std::size_t k) {
      return CutMesh::Vertex_index(static_cast<std::uint32_t>(t[k]));
    };
    if (mesh.add_face(vertex(0), vertex(1), vertex(2)) == CutMesh::null_face()) return false;
  }
  return true;
}

}  // namespace

struct ExactSolid::Exact {
  CutMesh mesh;
};

ExactSolid::ExactSolid(IndexedMesh mesh, std::shared_ptr<const Exact> exact)
    : mesh_(std::move(mesh)), exact_(std::move(exact)) {}

ExactSolid::ExactSolid(const IndexedMesh& mesh) : mesh_(mesh) {
  auto exact = std::make_shared<Exact>();
  for (const Vector3& p : mesh.points) {
    exact->mesh.add_vertex(CutKernel::Point_3(p.x(), p.y(), p.z()));
  }
  if (add_faces(mesh.triangles, exact->mesh)) exact_ = std::move(exact);
}

std::vector<ExactSolid> ExactSolid::cut(const CutPlane& plane) const {
  std::vector<ExactSolid> result;
  if (!is_solid()) return result;
  const double volume = mesh_volume(mesh_);
  double kept = 0.0;
  for (const double side : {1.0, -1.0}) {
    CutMesh half = exact_->mesh;
    const Vector3 normal = side * plane.normal;
    try {
      // What is on the negative side stays.
      processing::clip(half,
                       CutKernel::Plane_3(normal.x(), normal.y(), normal.z(), -side * plane.offset),
                       CGAL::parameters::clip_volume(true).throw_on_self_intersection(true));
    } catch (const std::exception&) {
      return {};
    }
    half.collect_garbage();
    if (half.is_empty() || !CGAL::is_closed(half) || !CGAL::is_triangle_mesh(half)) return {};
    std::vector<std::size_t> component(half.num_faces());
    const std::size_t count = processing::connected_components(
        half, boost::make_iterator_property_map(component.begin(), get(boost::face_index, half)));
    for (std::size_t k = 0; k < count; ++k) {
      auto exact = std::make_shared<Exact>();
      IndexedMesh rounded;
      std::vector<std::int32_t> number(half.num_vertices(), -1);
      for (const auto face : half.faces()) {
        if (component[face] != k) continue;
        Triangle triangle = corners_of(half, face);
        for (std::int32_t& v : triangle) {
          const CutMesh::Vertex_index vertex(static_cast<std::uint32_t>(v));
          if (number[v] < 0) {
            const CutKernel::Point_3& p = half.point(vertex);
            number[v] = static_cast<std::int32_t>(rounded.points.size());
            exact->mesh.add_vertex(p);
            rounded.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                                        CGAL::to_double(p.z()));
          }
          v = number[v];
        }
        rounded.triangles.push_back(triangle);
      }
      if (!add_faces(rounded.triangles, exact->mesh)) return {};
      kept += mesh_volume(rounded);
      result.push_back(ExactSolid(std::move(rounded), std::move(exact)));
    }
  }
  // Where the clip lost or doubled something the cut has failed.
  if (!(std::abs(kept - volume) < 1e-6 * volume)) result.clear();
  return result;
}

}  // namespace wscvt
