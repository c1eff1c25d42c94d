// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/nodes/space_nodes.h"
#include "wscvt/report/remesh_units.h"
#include "wscvt/report/remesh_warnings.h"
#include "wscvt/scan/coordinates.h"
#include "wscvt/scan/folded_solid_angle.h"
#include "wscvt/scan/point_cloud.h"
#include "wscvt/tessellation/seeding.h"

namespace wscvt {

namespace {

/// All that does not depend on the number of nodes, in the grain's units but for `input`.
struct PreparedGrain {
  Grain grain;
  MeshCheckReport input;  ///< in the input's units
  ShapeDescriptors original;
  MeshQuality original_quality;
  /// To the grain's mesh. It takes longer to make ready than to ask on a dense scan, so it is made
  /// once for all node counts that are tried.
  std::optional<MeshDistance> distance;
  std::string precision_warning;  ///< see precision_warning
};

bool measures_distances(const RemeshOptions& options) {
  return options.measures.distances ||
         (options.target.percent > 0.0 && options.target.measure == ErrorMeasure::Distance);
}

/// What the later stages read off the grain, made once.
void make_ready(PreparedGrain& prepared, const RemeshOptions& options, const Execution& execution) {
  Grain& grain = prepared.grain;
  execution.report(0.0, "Measuring the scan");
  prepared.original = describe_shape(grain.mesh, execution.part(0.0, 0.5));
  prepared.original_quality = measure_quality(grain.mesh, execution);
  const bool radial = grain.parametrization == Parametrization::Radial;
  if (radial && grain.is_scan && options.weighting.kind == Weighting::Curvature &&
      options.weighting.curvature_source == CurvatureSource::QuadricFit) {
    grain.curvatures = scan_curvatures(grain.mesh, execution);
  }
  if (radial && needs_rays(options.placement, grain.is_scan)) {
    grain.rays.emplace(grain.mesh, Vector3::Zero(), 1.0, execution);
  }
  if (measures_distances(options)) prepared.distance.emplace(grain.mesh, execution.part(0.9, 1.0));
}

PreparedGrain prepare(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  PreparedGrain prepared;
  const std::size_t points = scan.points.size();
  const std::size_t faces = scan.triangles.size();
  scan = with_surface(std::move(scan), options.points, execution.part(0.0, 0.4));
  const std::size_t different = scan.points.size();
  prepared.precision_warning = precision_warning(scan);
  CheckedMesh checked =
      check_mesh(std::move(scan), options.check, execution.part(options.points ? 0.4 : 0.0, 0.5));
  prepared.input = checked.report;
  if (options.points) count_given(points, faces, different, prepared.input);
  SurfaceOptions surface = options.surface;
  // The series and refinement are those of the radial map, so a grain that has one keeps it.
  const bool asks_for_radial =
      options.placement.kind == NodePlacement::Series || options.placement.refinement.rounds > 0;
  if (asks_for_radial && surface.parametrization == Parametrization::Auto &&
      folded_solid_angle(checked.mesh, checked.report.centroid, execution) <=
          0.01 * surface.fold_limit_percent) {
    surface.parametrization = Parametrization::Radial;
  }
  prepared.grain =
      grain_of_scan(std::move(checked), surface, options.node_count, execution.part(0.5, 0.9));
  make_ready(prepared, options, execution.part(0.9, 1.0));
  return prepared;
}

PreparedGrain prepare(const RadialSurface& surface, const RemeshOptions& options,
                      const Execution& execution) {
  PreparedGrain prepared;
  const SurfaceIntegrals integrals = integrate(surface, execution);
  prepared.grain = grain_of_surface(surface, integrals, execution);
  prepared.input.volume = integrals.volume;
  prepared.input.area = integrals.area;
  prepared.input.centroid = integrals.centroid;
  prepared.input.equivalent_radius = prepared.grain.unit;
  prepared.input.components = 1;
  make_ready(prepared, options, execution.part(0.9, 1.0));
  // The integrals are those of the surface itself, without its mesh's chords.
  const double unit = prepared.grain.unit;
  prepared.original.volume = 4.0 * pi / 3.0;
  prepared.original.area = integrals.area / (unit * unit);
  prepared.original.sphericity = 4.0 * pi / prepared.original.area;
  return prepared;
}

RelaxationResult tessellate(const Grain& grain, const RemeshOptions& options,
                            const Execution& execution) {
  execution.report(0.0, "Weighing the seeds");
  const bool weighted = options.seeding.sampling == Sampling::Weighted;
  WeightingOptions weighting = options.weighting;
  if (!weighted) weighting.kind = Weighting::Constant;
  const SurfaceSeedModel model(*grain.surface, weighting, options.node_count,
                               grain.curvatures ? &*grain.curvatures : nullptr, execution);
  if (!weighted) {
    RelaxationOptions none = options.relaxation;
    none.maximum_iterations = 0;
    return relax(unrelaxed_seeds(options.seeding.sampling, options.node_count), model, none,
                 execution);
  }
  MultilevelOptions levels = options.levels;
  if (options.seeding.start != SeedStart::Multilevel) levels.coarsest_seeds = options.node_count;
  const int coarsest = level_sizes(options.node_count, levels.coarsest_seeds).front();
  return relax_multilevel(start_seeds(options.seeding, model, coarsest, execution),
                          options.node_count, model, options.relaxation, levels,
                          execution.part(0.1, 1.0));
}

RemeshResult remesh_prepared(const PreparedGrain& prepared, const RemeshOptions& options,
                             const Execution& execution) {
  const Grain& grain = prepared.grain;
  RemeshResult result;
  result.options = options;
  // Samplings that are not relaxed are cut into cells on the sphere.
  RelaxationMetric& metric = result.options.relaxation.metric;
  if (options.seeding.sampling != Sampling::Weighted) metric = RelaxationMetric::Sphere;

  PlacedNodes nodes;
  if (grain.parametrization == Parametrization::Spherical) {
    metric = RelaxationMetric::Surface;
    SpaceNodes in_space = place_in_space(
        grain, options.node_count, options.seeding, options.weighting, options.relaxation,
        options.levels, options.placement, prepared.original.volume, execution.part(0.0, 0.9));
    result.relaxation = std::move(in_space.relaxation);
    result.space = in_space.report;
    nodes = std::move(in_space.placed);
  } else {
    RelaxationResult relaxed = tessellate(grain, result.options, execution.part(0.0, 0.7));
    result.relaxation = std::move(relaxed.report);
    nodes = place_nodes(grain, std::move(relaxed), metric, prepared.original.volume,
                        options.placement, execution.part(0.7, 0.9));
  }
  result.mesh = std::move(nodes.mesh);
  result.directions = std::move(nodes.directions);
  result.radial_distances = std::move(nodes.radii);
  result.cell_areas = std::move(nodes.cell_areas);
  result.refinement = std::move(nodes.refinement);
  if (options.measures.node_curvatures) {
    result.curvatures = grain.surface
                            ? largest_curvatures(*grain.surface, result.directions, execution)
                            : largest_curvatures(result.mesh, execution);
  }

  execution.report(0.9, "Measuring the remesh");
  result.remesh = describe_shape(result.mesh, execution.part(0.9, 0.92));
  result.quality = measure_quality(result.mesh, execution);
  if (prepared.distance) {
    const Execution measuring = execution.part(0.92, 0.98);
    measuring.report(0.0, "Measuring distances");
    result.distances = measure_distances(result.mesh, grain.mesh, *prepared.distance,
                                         options.measures.distance_sampling, measuring);
    result.vertex_distances = prepared.distance->distances(result.mesh.points, execution);
  }

  result.centre = grain.centre;
  result.input = prepared.input;
  result.folded_share = grain.folded_share;
  result.parametrization = grain.parametrization;
  result.steep_share = grain.steep_share;
  if (grain.parametrization == Parametrization::Spherical) result.map = grain.map.report;
  result.fit = grain.fit;
  result.coefficients = grain.coefficients;
  result.original = prepared.original;
  result.original_quality = prepared.original_quality;
  to_input_units(grain, result);
  return result;
}

RemeshResult remesh_to_target(const PreparedGrain& prepared, const RemeshOptions& options,
                              const Execution& execution) {
  const ErrorTarget& target = options.target;
  // The result with the smallest node count that met the target, or with the largest tried.
  RemeshResult best;
  bool best_meets = false;
  int trials = 0;
  const auto error = [&](int node_count) {
    RemeshOptions trial = options;
    trial.node_count = node_count;
    // How many trials there will be is not known; about ten are usual.
    const double begin = 1.0 - std::pow(0.85, trials);
    const double end = 1.0 - std::pow(0.85, ++trials);
    RemeshResult result;
    try {
      result = remesh_prepared(prepared, trial, execution.part(begin, end));
    } catch (const Error& failure) {
      // So few nodes that they do not surround the centre: from deep inside the stages, and rare.
      if (failure.code() != ErrorCode::NumericalFailure) throw;
      return std::numeric_limits<double>::infinity();
    }
    const double percent_off = error_percent(result, target.measure);
    const bool meets = percent_off <= target.percent;
    const int best_count = static_cast<int>(best.mesh.points.size());
    if (meets ? !best_meets || node_count < best_count : !best_meets && node_count > best_count) {
      best = std::move(result);
      best_meets = meets;
    }
    return percent_off;
  };
  NodeCountSearch search =
      smallest_node_count(target.percent, options.node_count, 4, target.largest_node_count, error);
  if (best.mesh.points.empty()) {
    throw Error(ErrorCode::NumericalFailure,
                "None of the node counts tried could be remeshed; allow more nodes.");
  }
  best.search = std::move(search);
  return best;
}

RemeshResult finish(const PreparedGrain& prepared, const RemeshOptions& options,
                    const Execution& execution) {
  RemeshResult result = options.target.percent > 0.0
                            ? remesh_to_target(prepared, options, execution)
                            : remesh_prepared(prepared, options, execution);
  result.warnings = remesh_warnings(result, prepared.precision_warning);
  execution.report(1.0, "Done");
  return result;
}

}  // namespace

RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  check_options(options);
  return finish(prepare(std::move(scan), options, execution.part(0.0, 0.3)), options,
                execution.part(0.3, 1.0));
}

RemeshResult remesh(const RadialSurface& surface, const RemeshOptions& options,
                    const Execution& execution) {
  check_options(options);
  return finish(prepare(surface, options, execution.part(0.0, 0.3)), options,
                execution.part(0.3, 1.0));
}

}  // namespace wscvt
