// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fragment/fragments.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <unordered_set>
#include <utility>

#include "toolbox/convex/convex_body.h"
#include "toolbox/fragment/cell_complex.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/mesh_distance.h"
#include "wscvt/remesh/remesh_warnings.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt {

namespace {

/// Returns the largest error of the volumes, over the wanted ones.
double volume_error(const std::vector<double>& volumes, const std::vector<double>& wanted) {
  double largest = 0.0;
  for (std::size_t k = 0; k < volumes.size(); ++k) {
    largest = std::max(largest, std::abs(volumes[k] / wanted[k] - 1.0));
  }
  return largest;
}

/// Returns the changes of the weights after which the volumes are the wanted ones, to first order:
/// a volume grows with its weight by the area of each wall over twice the sites' distance.
Eigen::VectorXd weight_changes(const CellComplex& complex, const std::vector<CellSite>& sites,
                               const std::vector<double>& wanted) {
  const auto count = static_cast<Eigen::Index>(sites.size());
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(count, count);
  double sum = 0.0;
  for (const CellComplex::Face& face : complex.faces()) {
    if (face.edges.empty() || !face.is_wall()) continue;
    const double area = 0.5 * doubled_area(complex.points(), face.edges).norm();
    const double apart = (sites[face.front].point - sites[face.back].point).norm();
    const double rate = area / (2.0 * apart);
    rates(face.front, face.front) += rate;
    rates(face.back, face.back) += rate;
    rates(face.front, face.back) -= rate;
    rates(face.back, face.front) -= rate;
    sum += rate;
  }
  // All weights may grow together; this keeps their mean.
  rates.array() += sum / static_cast<double>(count * count);
  Eigen::VectorXd missing(count);
  const std::vector<double> volumes = complex.volumes();
  for (Eigen::Index k = 0; k < count; ++k) {
    missing[k] = wanted[k] - volumes[k];
  }
  return rates.ldlt().solve(missing);
}

/// Cuts the grain. With volumes the weights of the sites change until the cells have them.
CellComplex cut_grain(const IndexedMesh& grain, double volume, std::vector<CellSite> sites,
                      const FragmentOptions& options, const Execution& execution) {
  CellComplex complex(grain, sites, execution.part(0.0, 0.3));
  if (options.volumes.empty()) return complex;
  const double sum = std::accumulate(options.volumes.begin(), options.volumes.end(), 0.0);
  std::vector<double> wanted;
  for (const double one : options.volumes) wanted.push_back(volume * one / sum);
  constexpr int most_cuts = 20;
  constexpr double allowed = 1e-3;
  double error = volume_error(complex.volumes(), wanted);
  double part = 1.0;
  for (int cut = 0; cut < most_cuts && error > allowed && part > 0.01; ++cut) {
    execution.report(0.3 + 0.7 * cut / most_cuts, "Fitting the fragments' volumes");
    const Eigen::VectorXd changes = weight_changes(complex, sites, wanted);
    std::vector<CellSite> next = sites;
    for (std::size_t k = 0; k < next.size(); ++k) {
      next[k].weight += part * changes[k];
    }
    CellComplex tried(grain, next, execution.part(0.3, 0.3));
    const double new_error = volume_error(tried.volumes(), wanted);
    if (new_error < error) {
      complex = std::move(tried);
      sites = std::move(next);
      error = new_error;
      part = std::min(1.0, 2.0 * part);
    } else {
      part *= 0.5;
    }
  }
  return complex;
}

void measure(Fragment& fragment) {
  const ShapeDescriptors shape = describe_shape(fragment.mesh, Execution(1));
  fragment.mass = mass_properties(shape);
  fragment.hull_excess_percent =
      100.0 * (convex_body(fragment.mesh.points).volume / shape.volume - 1.0);
}

/// Returns the cells' faces as triangles.
WallComplex walls_of(const CellComplex& cells) {
  const std::vector<Vector3>& points = cells.points();
  std::unordered_set<std::uint64_t> taken;
  for (const CellComplex::Face& face : cells.faces()) {
    for (const auto& [a, b] : face.edges) taken.insert(undirected_key(a, b));
  }
  WallComplex walls;
  std::vector<std::int32_t> numbers(points.size(), -1);
  for (const CellComplex::Face& face : cells.faces()) {
    if (face.edges.empty()) continue;
    for (const Triangle& t : face_triangles(points, face.edges, face.normal, taken)) {
      Triangle corners = t;
      for (std::int32_t& corner : corners) {
        std::int32_t& number = numbers[corner];
        if (number < 0) {
          number = static_cast<std::int32_t>(walls.points.size());
          walls.points.push_back(points[corner]);
        }
        corner = number;
      }
      if (face.back > face.front) std::swap(corners[1], corners[2]);
      walls.triangles.push_back(
          {corners, std::max(face.front, face.back), std::min(face.front, face.back)});
    }
  }
  return walls;
}

}  // namespace

Fragments fragment_grain(IndexedMesh scan, const FragmentOptions& options,
                         const Execution& execution) {
  check_options(options);
  const CheckedMesh checked =
      check_mesh(std::move(scan), MeshCheckOptions(), execution.part(0.0, 0.1));
  const ShapeDescriptors shape = describe_shape(checked.mesh, execution.part(0.1, 0.1));
  std::vector<CellSite> sites =
      fragment_sites(checked.mesh, shape, options, execution.part(0.1, 0.5));
  CellComplex complex =
      cut_grain(checked.mesh, shape.volume, std::move(sites), options, execution.part(0.5, 0.9));
  const CellComplex::Moved moved = complex.join_pieces();
  execution.report(0.9, "Making the fragments' meshes");
  Fragments result;
  result.list.resize(complex.cell_count());
  result.walls = walls_of(complex);
  measure_fragments(result, execution.part(0.9, 1.0));
  result.grain = shape;
  result.grain_edge = mean_edge_of(checked.mesh);
  result.moved_pieces = moved.pieces;
  result.moved_percent = 100.0 * moved.volume / shape.volume;
  append_repair_warnings(checked.report, "divided", result.warnings);
  if (options.near.empty()) return result;
  const MeshDistance surface(checked.mesh, execution);
  for (const double distance : surface.signed_distances(options.near, execution)) {
    const double away = distance / equivalent_radius(shape.volume);
    constexpr double far = 3.0;
    if (!(away > far)) continue;
    result.warnings.push_back(
        "A point near which fragments should be smaller is " + format_number(away, 3) +
        " equivalent radii away from the grain, so it has little effect. Give "
        "coordinates of the grain's file.");
  }
  return result;
}

void measure_fragments(Fragments& fragments, const Execution& execution) {
  for (Fragment& one : fragments.list) one.surface_area = one.wall_area = 0.0;
  std::vector<IndexedMesh> meshes = body_meshes(fragments.walls, fragments.list.size());
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    if (meshes[k].triangles.empty()) {
      throw Error(ErrorCode::NumericalFailure,
                  "Fragment " + std::to_string(k + 1) +
                      " would be empty. Give fewer fragments, or volumes that differ less.");
    }
    fragments.list[k].mesh = std::move(meshes[k]);
  }
  for (const WallTriangle& t : fragments.walls.triangles) {
    if (t.outer >= 0) continue;
    const std::vector<Vector3>& points = fragments.walls.points;
    fragments.list[t.inner].surface_area +=
        triangle_area(points[t.corners[0]], points[t.corners[1]], points[t.corners[2]]);
  }
  fragments.contacts = common_walls(fragments.walls);
  for (const CommonWall& wall : fragments.contacts) {
    fragments.list[wall.first].wall_area += wall.area;
    fragments.list[wall.second].wall_area += wall.area;
  }
  execution.parallel_for_each(fragments.list.size(), 1,
                              [&](std::size_t k) { measure(fragments.list[k]); });
}

}  // namespace wscvt
