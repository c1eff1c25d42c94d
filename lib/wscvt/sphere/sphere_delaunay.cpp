// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_delaunay.h"

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_on_sphere_vertex_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <cstddef>
#include <numeric>
#include <utility>

namespace wscvt {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactPoint = Kernel::Point_3;

ExactPoint exact_point(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

constexpr const char* delaunay_stage = "Triangulating the sphere";

/// A few hundredths of a second.
constexpr std::size_t insertions_a_report = 8192;

}  // namespace

std::vector<Triangle> sphere_delaunay(const std::vector<Vector3>& seeds,
                                      const Execution& execution) {
  using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<
      std::int32_t, Traits, CGAL::Triangulation_on_sphere_vertex_base_2<Traits>>;
  using FaceBase = CGAL::Triangulation_on_sphere_face_base_2<Traits>;
  using Triangulation = CGAL::Delaunay_triangulation_on_sphere_2<
      Traits, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

  std::vector<ExactPoint> points;
  points.reserve(seeds.size());
  for (const Vector3& seed : seeds) points.push_back(exact_point(seed));
  std::vector<std::size_t> order(seeds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  using Map = CGAL::Pointer_property_map<ExactPoint>::const_type;
  execution.report(0.0, delaunay_stage);
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>(
                         CGAL::make_property_map(std::as_const(points))));

  Triangulation triangulation(Traits(ExactPoint(0, 0, 0), 1));
  Triangulation::Face_handle hint;
  std::size_t inserted = 0;
  for (const std::size_t i : order) {
    if (inserted++ % insertions_a_report == 0) {
      execution.report(static_cast<double>(inserted) / static_cast<double>(order.size()),
                       delaunay_stage);
    }
    const auto vertex = triangulation.insert(points[i], hint);
    if (vertex == nullptr || triangulation.number_of_vertices() == 0) return {};
    vertex->info() = static_cast<std::int32_t>(i);
    hint = vertex->face();
  }
  execution.report(1.0, delaunay_stage);
  std::vector<Triangle> triangles;
  if (triangulation.number_of_vertices() != seeds.size()) return triangles;
  if (triangulation.number_of_ghost_faces() != 0) return triangles;
  triangles.reserve(triangulation.number_of_faces());
  for (const auto face : triangulation.all_face_handles()) {
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return triangles;
}

}  // namespace wscvt
