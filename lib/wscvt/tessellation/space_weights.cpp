// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/space_weights.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

namespace {

constexpr std::size_t shape_block = 1024;

/// Takes means over the vertices' rings, by area, as often as carries a value `distance` far: one
/// round has the spread of a walk by one edge.
void smooth(const IndexedMesh& mesh, const std::vector<double>& areas, double distance,
            std::vector<double>& values) {
  constexpr int most_rounds = 400;
  double squared_edges = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      squared_edges += (mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]).squaredNorm();
    }
  }
  squared_edges /= 3.0 * static_cast<double>(mesh.triangles.size());
  const double wanted = std::ceil(distance * distance / squared_edges);
  const int rounds = static_cast<int>(std::clamp(wanted, 1.0, 1.0 * most_rounds));
  std::vector<double> moments(values.size());
  std::vector<double> measures(values.size());
  for (int round = 0; round < rounds; ++round) {
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

}  // namespace

Weighting weighting_in_space(Weighting asked) {
  return asked == Weighting::Curvature || asked == Weighting::ErrorAdaptive ? asked
                                                                            : Weighting::Area;
}

bool reads_map_series(const WeightingOptions& options) {
  return options.kind == Weighting::Curvature &&
         options.curvature_source == CurvatureSource::Series;
}

std::vector<PrincipalCurvatures> curvatures_in_space(const MappedSurface& surface,
                                                     const HarmonicMap* series,
                                                     const WeightingOptions& options,
                                                     const Execution& execution) {
  check_weighting_options(options);
  if (weighting_in_space(options.kind) == Weighting::Area) return {};
  if (!reads_map_series(options)) {
    // The paper fits over one ring, which scans leave under-determined.
    constexpr int rings = 2;
    return quadric_fit_curvatures(surface.mesh(), rings, execution);
  }
  if (series == nullptr) {
    throw Error(
        ErrorCode::InvalidInput,
        "The weighting reads the curvature of the harmonic map, and there is none; give the "
        "fitted one, or take the curvature of quadrics.");
  }
  const std::vector<Vector3>& directions = surface.directions();
  std::vector<PrincipalCurvatures> curvatures(directions.size());
  execution.parallel_for(directions.size(), shape_block, [&](std::size_t begin, std::size_t end) {
    std::vector<LocalShape> shapes(end - begin);
    series->evaluate_shapes(directions.data() + begin, shapes.size(), Derivatives::Second,
                            shapes.data());
    for (std::size_t i = begin; i < end; ++i) {
      const PrincipalCurvatures& k = shapes[i - begin].curvatures;
      // Where a map folds it has no normal: a vertex there says nothing.
      if (std::isfinite(k.maximum) && std::isfinite(k.minimum)) curvatures[i] = k;
    }
  });
  return curvatures;
}

std::vector<double> densities_in_space(const IndexedMesh& mesh,
                                       const std::vector<PrincipalCurvatures>& curvatures,
                                       const WeightingOptions& options, int node_count) {
  check_weighting_options(options);
  const Weighting weighting = weighting_in_space(options.kind);
  if (weighting == Weighting::Area) return {};
  if (curvatures.size() != mesh.points.size()) {
    throw Error(ErrorCode::InvalidInput,
                "There are " + std::to_string(curvatures.size()) + " pairs of curvatures for " +
                    std::to_string(mesh.points.size()) + " vertices; give one each.");
  }
  const std::vector<double> areas = vertex_areas(mesh);
  double area = 0.0;
  for (const double part : areas) area += part;
  const double radius = std::sqrt(area / (4.0 * pi));
  std::vector<double> field;
  field.reserve(areas.size());
  for (const PrincipalCurvatures& k : curvatures) {
    const double largest = std::max(k.maximum * k.maximum, k.minimum * k.minimum);
    const double mean = 0.5 * (k.maximum * k.maximum + k.minimum * k.minimum);
    field.push_back(weighting == Weighting::Curvature ? largest : mean);
  }
  smooth(mesh, areas, 0.6 * std::sqrt(area / node_count), field);
  for (double& square : field) square = std::sqrt(square) * radius;

  if (weighting == Weighting::ErrorAdaptive) {
    std::vector<double> order = field;
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::nth_element(order.begin(), middle, order.end());
    const double floor = std::max(flat_share_of_median * *middle, flat_curvature);
    for (double& k : field) k = std::pow(std::max(k, floor), options.adaptive_exponent);
    return field;
  }
  double mean = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    field[i] = -std::log(std::max(field[i], flat_curvature));
    mean += areas[i] * field[i] / area;
  }
  double variance = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    variance += areas[i] * (field[i] - mean) * (field[i] - mean) / area;
  }
  // A sphere has no deviation to measure by.
  if (!(variance > 1e-18)) return {};
  for (double& value : field) {
    const double x = options.curvature_alpha * (value - mean) / (3.0 * std::sqrt(variance));
    const double weight = 4.0 * std::clamp(x, -curvature_clip, curvature_clip);
    const double cell = 1.0 + cell_area_per_weight * weight / (4.0 * pi);
    value = 1.0 / std::max(smallest_cell_share, cell);
  }
  return field;
}

}  // namespace wscvt
