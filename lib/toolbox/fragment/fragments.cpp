// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fragment/fragments.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <unordered_set>
#include <utility>

#include "toolbox/convex/convex_body.h"
#include "toolbox/fragment/cell_complex.h"
#include "toolbox/fragment/face_triangles.h"
#include "toolbox/fragment/fragment_sites.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
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
    const double area = 0.5 * doubled_area(complex.points(), face.edges.data(),
                                           face.edges.data() + face.edges.size())
                                  .norm();
    const double apart = (sites[static_cast<std::size_t>(face.front)].point -
                          sites[static_cast<std::size_t>(face.back)].point)
                             .norm();
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
    missing[k] = wanted[static_cast<std::size_t>(k)] - volumes[static_cast<std::size_t>(k)];
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
      next[k].weight += part * changes[static_cast<Eigen::Index>(k)];
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

/// Collects the triangles of a fragment, with its own numbers of the points.
class FragmentMesh {
 public:
  void add(const std::vector<Vector3>& points, const Triangle& triangle) {
    Triangle own{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, is_new] =
          numbers_.try_emplace(triangle[k], static_cast<std::int32_t>(mesh.points.size()));
      if (is_new) mesh.points.push_back(points[triangle[k]]);
      own[k] = found->second;
    }
    mesh.triangles.push_back(own);
  }
  IndexedMesh mesh;

 private:
  std::map<std::int32_t, std::int32_t> numbers_;
};

void measure(Fragment& fragment) {
  const ShapeDescriptors shape = describe_shape(fragment.mesh, Execution(1));
  fragment.mass = mass_properties(shape);
  fragment.hull_excess_percent =
      100.0 * (convex_body(fragment.mesh.points).volume / shape.volume - 1.0);
}

/// Makes the fragments' meshes and the contacts from the cells.
Fragments fragments_of(const CellComplex& complex, const Execution& execution) {
  std::vector<FragmentMesh> meshes(complex.cell_count());
  std::map<std::array<std::size_t, 2>, FragmentContact> contacts;
  Fragments result;
  result.list.resize(complex.cell_count());
  const std::vector<Vector3>& points = complex.points();
  std::unordered_set<std::uint64_t> taken;
  for (const CellComplex::Face& face : complex.faces()) {
    for (const auto& [a, b] : face.edges) taken.insert(undirected_key(a, b));
  }
  for (const CellComplex::Face& face : complex.faces()) {
    if (face.edges.empty()) continue;
    const auto front = static_cast<std::size_t>(face.front);
    const auto back = static_cast<std::size_t>(face.back);
    for (const Triangle& t : face_triangles(points, face.edges, face.normal, taken)) {
      meshes[front].add(points, t);
      const Vector3 doubled = doubled_area_normal(points[t[0]], points[t[1]], points[t[2]]);
      const double area = 0.5 * doubled.norm();
      if (!face.is_wall()) {
        result.list[front].surface_area += area;
        continue;
      }
      meshes[back].add(points, {t[0], t[2], t[1]});
      result.list[front].wall_area += area;
      result.list[back].wall_area += area;
      FragmentContact& contact = contacts[{std::min(front, back), std::max(front, back)}];
      contact.area += area;
      contact.centre += area / 3.0 * (points[t[0]] + points[t[1]] + points[t[2]]);
      contact.normal += front < back ? doubled : Vector3(-doubled);
    }
  }
  for (auto& [pair, contact] : contacts) {
    contact.first = pair[0];
    contact.second = pair[1];
    contact.centre /= contact.area;
    contact.normal.normalize();
    result.contacts.push_back(contact);
  }
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    result.list[k].mesh = std::move(meshes[k].mesh);
    if (result.list[k].mesh.triangles.empty()) {
      throw Error(ErrorCode::NumericalFailure,
                  "Fragment " + std::to_string(k + 1) +
                      " would be empty. Give fewer fragments, or volumes that differ less.");
    }
  }
  execution.parallel_for(result.list.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) measure(result.list[k]);
  });
  return result;
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
  Fragments result = fragments_of(complex, execution.part(0.9, 1.0));
  result.grain = shape;
  result.moved_pieces = moved.pieces;
  result.moved_percent = 100.0 * moved.volume / shape.volume;
  append_repair_warnings(checked.report, "divided", result.warnings);
  for (const Vector3& point : options.near) {
    const double away = (point - shape.centroid).norm() / equivalent_radius(shape.volume);
    constexpr double far = 4.0;
    if (!(away > far)) continue;
    result.warnings.push_back(
        "A point near which fragments should be smaller is " + format_number(away, 3) +
        " equivalent radii away from the grain's centroid, so it has little effect. Give "
        "coordinates of the grain's file.");
  }
  return result;
}

}  // namespace wscvt
