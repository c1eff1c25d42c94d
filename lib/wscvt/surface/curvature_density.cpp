// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/curvature_density.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/curvature.h"

namespace wscvt {

namespace {

/// Curvatures below this, in 1 / radius of the sphere of equal area, are raised to it, because a
/// flat face has no scale.
constexpr double flat_curvature_in_space = 0.01;
/// Largest alpha x of eq. 11, so that no wanted cell is negative.
constexpr double most_weight = 0.9;
/// The paper's law: cell area = 3.118 w + C.
constexpr double area_per_weight = 3.118;
constexpr double least_cell_share = 0.05;
/// Smallest deviation of the logarithm of the curvature; below it the grain counts as a sphere. Eq.
/// 14 divides by the deviation, and would otherwise gather nodes by a scanned sphere's noise.
constexpr double least_deviation = 0.05;
/// Radius of the discs over which curvatures are averaged, in sqrt(area per node).
constexpr double disc_radius = 0.6;

/// Averages over the vertices' rings, by area, as often as needed to carry a value over `distance`:
/// each round spreads it like a random walk by one edge.
void spread(const IndexedMesh& mesh, const std::vector<double>& areas, double distance,
            std::vector<double>& values, const Execution& execution) {
  constexpr double most_rounds = 400.0;
  double squared_edges = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    squared_edges += (mesh.points[a] - mesh.points[b]).squaredNorm() +
                     (mesh.points[b] - mesh.points[c]).squaredNorm() +
                     (mesh.points[c] - mesh.points[a]).squaredNorm();
  }
  squared_edges /= 3.0 * static_cast<double>(mesh.triangles.size());
  const double wanted = std::ceil(distance * distance / squared_edges);
  const int rounds = static_cast<int>(std::clamp(wanted, 1.0, most_rounds));
  std::vector<double> moments(values.size());
  std::vector<double> measures(values.size());
  for (int round = 0; round < rounds; ++round) {
    execution.report(0.0, "Computing weights");
    std::fill(moments.begin(), moments.end(), 0.0);
    std::fill(measures.begin(), measures.end(), 0.0);
    for (const Triangle& t : mesh.triangles) {
      double moment = 0.0;
      double measure = 0.0;
      for (const std::int32_t v : t) {
        moment += areas[v] * values[v];
        measure += areas[v];
      }
      for (const std::int32_t v : t) {
        moments[v] += moment;
        measures[v] += measure;
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (measures[i] > 0.0) values[i] = moments[i] / measures[i];
    }
  }
}

double weighted_mean(const std::vector<double>& areas, const std::vector<double>& values) {
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += areas[i] * values[i];
    area += areas[i];
  }
  return sum / area;
}

/// Eqs. 11 to 14; false on a sphere, whose deviation is zero.
bool weigh_curvature(std::vector<double>& field, const std::vector<double>& areas, double alpha) {
  for (double& k : field) k = -portable::log(std::max(k, flat_curvature_in_space));
  const double mean = weighted_mean(areas, field);
  std::vector<double> squares;
  squares.reserve(field.size());
  for (const double value : field) squares.push_back((value - mean) * (value - mean));
  const double deviation = std::sqrt(weighted_mean(areas, squares));
  if (!(deviation > 1e-9)) return false;
  for (double& value : field) {
    const double x = alpha * (value - mean) / (3.0 * std::max(deviation, least_deviation));
    const double weight = 4.0 * std::clamp(x, -most_weight, most_weight);
    const double cell = 1.0 + area_per_weight * weight / (4.0 * pi);
    value = 1.0 / std::max(least_cell_share, cell);
  }
  return true;
}

}  // namespace

std::vector<double> curvature_density(const IndexedMesh& surface, double alpha, int node_count,
                                      const Execution& execution) {
  constexpr int rings = 2;  // the paper fits over one, which scans leave under-determined
  const std::vector<PrincipalCurvatures> curvatures =
      quadric_fit_curvatures(surface, rings, execution);
  const std::vector<double> areas = vertex_areas(surface);
  double area = 0.0;
  for (const double part : areas) area += part;
  std::vector<double> field;
  field.reserve(curvatures.size());
  for (const PrincipalCurvatures& k : curvatures) {
    field.push_back(std::max(k.maximum * k.maximum, k.minimum * k.minimum));
  }
  spread(surface, areas, disc_radius * std::sqrt(area / node_count), field, execution);
  const double radius = std::sqrt(area / (4.0 * pi));
  for (double& square : field) square = std::sqrt(square) * radius;
  if (!weigh_curvature(field, areas, alpha)) return {};
  const double mean = weighted_mean(areas, field);
  for (double& density : field) density /= mean;
  return field;
}

std::vector<double> steepened(std::vector<double> density, const IndexedMesh& surface,
                              double power) {
  if (density.empty()) return density;
  for (double& value : density) value = portable::pow(value, power);
  const double mean = weighted_mean(vertex_areas(surface), density);
  for (double& value : density) value /= mean;
  return density;
}

}  // namespace wscvt
