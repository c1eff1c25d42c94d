// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_triangulation.h"

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_on_sphere_vertex_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {

namespace {

/// Largest absolute weight in steradian. Beyond it, the predicates' products of exp(w / 2) may
/// overflow or underflow: exp(200 / 2)^3 = 1e130. The whole sphere has 4 pi.
constexpr double weight_limit = 200.0;

constexpr std::size_t triangle_block = 4096;

bool can_be_lifted(const std::vector<double>& weights) {
  return std::all_of(weights.begin(), weights.end(),
                     [](double weight) { return std::abs(weight) <= weight_limit; });
}

/// Whether the triangle's height, seen from the centre, is below a millionth of its longest side.
bool is_nearly_flat(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return !(six_volumes(a, b, c) > 1e-6 * longest);
}

/// Returns the points whose convex hull is the regular triangulation. For circles of angular radius
/// r about p these are p / cos(r) (Sugihara 2002, "Laguerre Voronoi diagram on the sphere", J.
/// Geom. Graph. 6, 69-81); exp(w / 2) equals 1 / cos(r) for w = r^2 up to terms in r^4, and is also
/// defined for weights below 0, which have no circle.
std::vector<Vector3> lift(const std::vector<Vector3>& seeds, const std::vector<double>& weights) {
  std::vector<Vector3> lifted(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i)
    lifted[i] = seeds[i] * portable::exp(0.5 * weights[i]);
  return lifted;
}

/// Whether the triangles have the number that covers the sphere once, and are all
/// counter-clockwise. By Euler's formula they then leave no gap and do not overlap.
bool covers_sphere(const std::vector<Triangle>& triangles, const std::vector<Vector3>& seeds,
                   const Execution& execution) {
  if (triangles.size() != 2 * seeds.size() - 4) return false;
  const std::size_t turned = execution.parallel_sum_of(
      triangles.size(), triangle_block, std::size_t{0}, [&](std::size_t i, std::size_t& count) {
        const auto& [a, b, c] = triangles[i];
        if (!counter_clockwise(seeds[a], seeds[b], seeds[c])) ++count;
      });
  return turned == 0;
}

}  // namespace

SphereTriangulation::SphereTriangulation(const std::vector<Vector3>& seeds,
                                         const std::vector<double>& weights,
                                         const Execution& execution) {
  if (const char* reason = build(seeds, weights, execution)) {
    throw Error(ErrorCode::NumericalFailure,
                std::string("The seeds cannot be triangulated on the sphere: ") + reason);
  }
}

std::optional<SphereTriangulation> SphereTriangulation::try_build(
    const std::vector<Vector3>& seeds, const std::vector<double>& weights,
    const Execution& execution) {
  SphereTriangulation result;
  if (result.build(seeds, weights, execution) != nullptr) return std::nullopt;
  return result;
}

const char* SphereTriangulation::build(const std::vector<Vector3>& seeds,
                                       const std::vector<double>& weights,
                                       const Execution& execution) {
  if (seeds.size() < 4) {
    refuse("A triangulation of the sphere needs at least 4 seeds, not " +
           std::to_string(seeds.size()) + ".");
  }
  if (!weights.empty() && weights.size() != seeds.size()) {
    refuse("There are " + std::to_string(weights.size()) + " weights for " +
           std::to_string(seeds.size()) + " seeds. Give one each, or none.");
  }
  // The exact arithmetic of the predicates ends the program at NaN.
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (seeds[i].allFinite()) continue;
    refuse("Seed " + std::to_string(i) + " is not a finite direction. Give unit vectors.");
  }
  if (!can_be_lifted(weights)) {
    return "a weight is not a number, or far larger than the sphere's own solid angle. Use more "
           "nodes, or another weighting.";
  }
  // The Delaunay triangulation and flips are several times as fast as a convex hull, and with
  // moderate weights few edges differ. Very different weights may leave edges that flips cannot
  // remove (Edelsbrunner and Shah 1996: flips in the plane get stuck). Then the hull is used.
  std::vector<Triangle> triangles = sphere_delaunay(seeds, execution);
  if (covers_sphere(triangles, seeds, execution)) {
    set_triangles(std::move(triangles), seeds.size(), execution);
    // Also applies our own predicate to cocircular seeds, instead of CGAL's choice.
    if (restore_regular(seeds, weights, execution).complete) {
      set_triangles(std::move(triangles_), seeds.size(), execution);
      return nullptr;
    }
  }
  triangles = convex_hull_triangles(weights.empty() ? seeds : lift(seeds, weights), execution);
  if (!covers_sphere(triangles, seeds, execution)) {
    return "they do not surround the grain's centre, two coincide, or a weight is so low that its "
           "seed has no cell. Use more nodes, or a smaller strength alpha.";
  }
  set_triangles(std::move(triangles), seeds.size(), execution);
  return nullptr;
}

SphereTriangulation::SphereTriangulation(const std::vector<Vector3>& seeds,
                                         std::vector<Triangle> triangles,
                                         const Execution& execution) {
  const auto count = static_cast<std::int32_t>(seeds.size());
  bool usable = count >= 4 && std::all_of(seeds.begin(), seeds.end(),
                                          [](const Vector3& seed) { return seed.allFinite(); });
  for (const Triangle& t : triangles) {
    for (const std::int32_t v : t) usable = usable && v >= 0 && v < count;
  }
  if (usable && covers_sphere(triangles, seeds, execution)) {
    set_triangles(std::move(triangles), seeds.size(), execution);
    usable = std::find(opposite_.begin(), opposite_.end(), -1) == opposite_.end();
  } else {
    usable = false;
  }
  if (!usable) {
    refuse("The triangles do not cover the sphere once with all " + std::to_string(count) +
           " seeds as corners.");
  }
}

void SphereTriangulation::set_triangles(std::vector<Triangle> triangles, std::size_t vertices,
                                        const Execution& execution) {
  // Sort the triangles, each from its smallest corner: equal seeds get equal arrays, however they
  // were triangulated. Grouping two million by that corner, in parallel, took as long as this sort
  // (0.23 s).
  triangles_ = std::move(triangles);
  for (Triangle& t : triangles_) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles_.begin(), triangles_.end());
  HalfEdges links = link_half_edges(triangles_, vertices, execution);
  opposite_ = std::move(links.opposite);
  first_half_edge_ = std::move(links.first);
}

bool SphereTriangulation::is_flippable(std::int32_t half_edge,
                                       const std::vector<Vector3>& seeds) const {
  const std::int32_t other = opposite_[half_edge];
  const Vector3& a = seeds[origin(half_edge)];
  const Vector3& b = seeds[origin(other)];
  const Vector3& c = seeds[apex(half_edge)];
  const Vector3& d = seeds[apex(other)];
  return counter_clockwise(c, a, d) && counter_clockwise(d, b, c);
}

template <class NeedsFlip>
SphereTriangulation::Repair SphereTriangulation::flip_while(const std::vector<Vector3>& seeds,
                                                            const NeedsFlip& needs_flip,
                                                            const Execution& execution) {
  // The search for edges to flip takes most of the time and runs in parallel. Flips are few and run
  // in a fixed order. Blocks are small enough for the coarsest levels' hundreds of triangles.
  constexpr std::size_t block = 256;
  const std::size_t count = triangles_.size();
  std::vector<std::vector<std::int32_t>> found((count + block - 1) / block);
  std::vector<char> turned_over(found.size(), 0);
  execution.parallel_for(count, block, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t>& edges = found[begin / block];
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& corners = triangles_[t];
      if (!counter_clockwise(seeds[corners[0]], seeds[corners[1]], seeds[corners[2]])) {
        turned_over[begin / block] = 1;
        return;
      }
      for (std::int32_t k = 0; k < 3; ++k) {
        const auto h = static_cast<std::int32_t>(3 * t) + k;
        if (h < opposite_[h] && needs_flip(h)) edges.push_back(h);
      }
    }
  });
  if (std::find(turned_over.begin(), turned_over.end(), 1) != turned_over.end()) return {0, false};
  Repair repair;
  std::vector<std::int32_t> stack;
  for (const auto& edges : found) stack.insert(stack.end(), edges.begin(), edges.end());
  std::vector<std::int32_t> stuck;
  // Regular flips end: each replaces a valley of the lifted surface by a ridge, so the surface only
  // rises, and there are finitely many triangulations (Lawson 1977). Flips by the surface's angles
  // lower the Dirichlet energy of functions linear on the triangles if the surface does not change
  // (Bobenko and Springborn 2007). But here the new edge is straight in space and changes the
  // surface, so flips could cycle. The limit prevents that.
  const int limit = static_cast<int>(std::min<std::size_t>(50 * count, 1U << 30));
  bool progress = true;
  while (progress) {
    progress = false;
    while (!stack.empty() && repair.flips < limit) {
      const std::int32_t h = stack.back();
      stack.pop_back();
      if (!needs_flip(h)) continue;
      // If the edge's two triangles make no convex quadrilateral, it stays for now. A neighbouring
      // flip may make it possible.
      if (!is_flippable(h, seeds)) {
        stuck.push_back(h);
        continue;
      }
      const std::int32_t t0 = h / 3 * 3;
      const std::int32_t t1 = opposite_[h] / 3 * 3;
      flip_edge(h, triangles_, opposite_);
      ++repair.flips;
      progress = true;
      for (const std::int32_t edge : {t0, t0 + 1, t1, t1 + 1}) {
        first_half_edge_[origin(edge)] = edge;
        stack.push_back(edge);
      }
    }
    // Not swapped, because edges that the limit leaves on the stack also count as stuck.
    stack.insert(stack.end(), stuck.begin(), stuck.end());
    stuck.clear();
    if (stack.empty()) break;
  }
  repair.complete = std::none_of(stack.begin(), stack.end(), needs_flip);
  return repair;
}

SphereTriangulation::Repair SphereTriangulation::restore_regular(const std::vector<Vector3>& seeds,
                                                                 const std::vector<double>& weights,
                                                                 const Execution& execution) {
  if (!can_be_lifted(weights)) return {0, false};
  const std::vector<Vector3> storage =
      weights.empty() ? std::vector<Vector3>() : lift(seeds, weights);
  const std::vector<Vector3>& lifted = weights.empty() ? seeds : storage;
  return flip_while(
      seeds,
      [&](std::int32_t h) {
        const std::int32_t other = opposite_[h];
        return orientation(lifted[origin(h)], lifted[origin(other)], lifted[apex(h)],
                           lifted[apex(other)]) > 0;
      },
      execution);
}

SphereTriangulation::Repair SphereTriangulation::restore_surface_delaunay(
    const std::vector<Vector3>& seeds, const std::vector<Vector3>& positions,
    const Execution& execution) {
  return flip_while(
      seeds,
      [&](std::int32_t h) {
        const std::int32_t other = opposite_[h];
        const Vector3& a = positions[origin(h)];
        const Vector3& b = positions[origin(other)];
        const Vector3& c = positions[apex(h)];
        const Vector3& d = positions[apex(other)];
        // The angles at c and d sum to more than pi if cot + cot < 0.
        const double cosine_c = (a - c).dot(b - c);
        const double cosine_d = (a - d).dot(b - d);
        if (cosine_c >= 0.0 && cosine_d >= 0.0) return false;
        const double sine_c = (a - c).cross(b - c).norm();
        const double sine_d = (a - d).cross(b - d).norm();
        const double left = sine_c * cosine_d;
        const double right = cosine_c * sine_d;
        // For four points on a circle both diagonals are equal. Rounding, some 1e-15 here, must not
        // flip them repeatedly.
        if (!(left + right < -1e-12 * (std::abs(left) + std::abs(right)))) return false;
        // Three seeds of a lattice often lie on one great circle, except for rounding. The exact
        // predicate then allows a triangle between them, but rounding of its positions makes it
        // flat.
        const Vector3& apex_c = seeds[apex(h)];
        const Vector3& apex_d = seeds[apex(other)];
        return !is_nearly_flat(apex_c, seeds[origin(h)], apex_d) &&
               !is_nearly_flat(apex_d, seeds[origin(other)], apex_c);
      },
      execution);
}

IndexedMesh subdivided_sphere(int frequency) {
  IndexedMesh mesh;
  mesh.points = subdivided_icosahedron(frequency);
  mesh.triangles = SphereTriangulation(mesh.points).triangles();
  return mesh;
}

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

int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return static_cast<int>(
      CGAL::orientation(exact_point(a), exact_point(b), exact_point(c), exact_point(d)));
}

}  // namespace wscvt
