// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh_stages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/pi.h"
#include "wscvt/nodes/space_nodes.h"
#include "wscvt/report/remesh_units.h"
#include "wscvt/scan/coordinates.h"
#include "wscvt/scan/envelope.h"
#include "wscvt/scan/handles.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/scan/point_cloud.h"
#include "wscvt/surface/harmonic_map.h"
#include "wscvt/surface/parametrization_choice.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/seeding.h"
#include "wscvt/tessellation/space_weights.h"

namespace wscvt {

namespace {

bool measures_distances(const RemeshOptions& options) {
  return options.measures.distances ||
         (options.target.percent > 0.0 && options.target.measure == ErrorMeasure::Distance);
}

/// The largest number of nodes that will be asked of the prepared grain.
int most_nodes(const RemeshOptions& options) {
  return options.target.percent > 0.0
             ? std::max(options.node_count, options.target.largest_node_count)
             : options.node_count;
}

/// Above this folded_solid_angle the series' residual is read off the whole scan: below it the rays
/// of the fit, which see the outermost sheet alone, are within 2 % (four scans), above it up to 12
/// and, where 8 % lie behind another sheet, 54 % too small.
constexpr double told_by_rays = 1e-3;

/// Root mean square of the distance from the scan, with all its sheets, to the series; length.
double residual_of_folds(const Grain& grain, const Execution& execution) {
  // 5,762 points, whose edges are a sixth of the wavelength of degree 20; and as many samples as it
  // takes for the few on hidden sheets, which are far from it, to come out within 1 %.
  constexpr int frequency = 24;
  constexpr std::size_t samples = 10000;
  return rms_distance(grain.mesh, mesh_of_surface(*grain.surface, frequency, execution), samples,
                      execution);
}

/// Of the series for x, y and z of a mapped scan.
int map_degree(const SurfaceOptions& options) {
  constexpr int usual_degree = 20;
  return options.degree == automatic_degree ? usual_degree : options.degree;
}

/// What the later stages read off the grain, made once.
void make_ready(PreparedGrain& prepared, const RemeshOptions& options, const Execution& execution) {
  Grain& grain = prepared.grain;
  execution.report(0.0, "Measuring the scan");
  prepared.original = describe_shape(grain.mesh, execution.part(0.0, 0.5));
  prepared.original_quality = measure_quality(grain.mesh, execution);
  const bool radial = grain.parametrization == Parametrization::Radial;
  if (radial && grain.is_scan && grain.folded_share > told_by_rays) {
    grain.fit.residual = residual_of_folds(grain, execution);
  }
  if (radial && !grain.rays && needs_rays(options.placement, grain.is_scan)) {
    grain.rays.emplace(grain.mesh, Vector3::Zero(), 1.0, execution);
  }
  read_curvatures(prepared, options, execution.part(0.5, 0.9));
  if (measures_distances(options) || grain.is_level) {
    prepared.distance.emplace(grain.mesh, execution.part(0.9, 1.0));
  }
}

RelaxationResult tessellate(const Grain& grain, const RemeshOptions& options,
                            const Execution& execution) {
  execution.report(0.0, "Weighing the seeds");
  const bool weighted = options.seeding.sampling == Sampling::Weighted;
  WeightingOptions weighting = options.weighting;
  if (!weighted) weighting.kind = Weighting::Constant;
  const SurfaceSeedModel model(*grain.surface, weighting, options.node_count,
                               grain.curvatures ? &*grain.curvatures : nullptr, execution,
                               options.relaxation.metric);
  if (!weighted) {
    RelaxationOptions none = options.relaxation;
    none.maximum_iterations = 0;
    return relax(unrelaxed_seeds(options.seeding.sampling, options.node_count), model, none,
                 execution);
  }
  // On the surface so coarse a level makes triangles less even: of five smooth grains with 500 and
  // 2000 nodes the mean edge ratio is .005 to .017 higher than from twice as many seeds.
  const int times = options.relaxation.metric == RelaxationMetric::Surface ? 2 : 1;
  MultilevelOptions levels = with_more_seeds(options.levels, times);
  if (options.seeding.start != SeedStart::Multilevel) levels.coarsest_seeds = options.node_count;
  const int coarsest = level_sizes(options.node_count, levels.coarsest_seeds).front();
  return relax_multilevel(start_seeds(options.seeding, model, coarsest, execution),
                          options.node_count, model, options.relaxation, levels,
                          execution.part(0.1, 1.0));
}

}  // namespace

PreparedGrain prepare(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  PreparedGrain prepared;
  const std::size_t points = scan.points.size();
  const std::size_t faces = scan.triangles.size();
  const bool wraps = options.envelope.opening_percent > 0.0;
  if (wraps && options.points) {
    // Not of a surface made of the points by their rays: the envelope sees what lies behind others.
    scan.triangles.clear();
  } else {
    scan = with_surface(std::move(scan), options.points, execution.part(0.0, 0.3));
  }
  const std::size_t different = scan.points.size();
  prepared.precision_warning = precision_warning(scan);
  if (wraps) {
    scan = envelope_of(std::move(scan), options.envelope, execution.part(0.3, 0.35));
  }
  CheckedMesh checked = check_mesh(std::move(scan), options.check,
                                   execution.part(options.points || wraps ? 0.35 : 0.0, 0.4));
  if (options.measures.used_scan) prepared.used_scan = checked.mesh;
  // The series is that of the radial map, so a grain that has one keeps it.
  const bool needs_series = options.placement.kind == NodePlacement::Series;
  const ParametrizationChoice choice =
      choose_parametrization(checked.mesh, checked.report.centroid, options.surface, needs_series,
                             execution.part(0.4, 0.45));
  // Rays go past a tunnel, but no map to the sphere does.
  if (choice.taken == Parametrization::Spherical && checked.report.genus > 0) {
    prepared.handles = cut_handles(checked, options.handles, execution.part(0.45, 0.5));
  }
  prepared.input = checked.report;
  if (options.points || wraps) count_given(points, faces, different, prepared.input);
  prepared.grain = grain_of_scan(std::move(checked), choice, options.surface, most_nodes(options),
                                 execution.part(0.5, 0.9));
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

void read_curvatures(PreparedGrain& prepared, const RemeshOptions& options,
                     const Execution& execution) {
  Grain& grain = prepared.grain;
  const bool radial = grain.parametrization == Parametrization::Radial;
  grain.curvatures.reset();
  if (radial && grain.is_scan && options.weighting.kind == Weighting::Curvature &&
      options.weighting.curvature_source == CurvatureSource::QuadricFit) {
    grain.curvatures = scan_curvatures(grain.mesh, execution);
  }
  if (!grain.mapped) return;
  const bool reads_series = options.measures.coefficients || reads_map_series(options.weighting);
  if (reads_series && !grain.map_series) {
    grain.map_series =
        fit_harmonic_map(*grain.mapped, map_degree(options.surface), execution.part(0.0, 0.8));
  }
  grain.map_curvatures =
      curvatures_in_space(*grain.mapped, grain.map_series ? &grain.map_series->map : nullptr,
                          options.weighting, execution.part(0.8, 1.0));
}

RemeshResult remesh_prepared(const PreparedGrain& prepared, const RemeshOptions& options,
                             const Execution& execution) {
  const Grain& grain = prepared.grain;
  RemeshResult result;
  result.options = options;
  // Samplings that are not relaxed are cut into cells on the sphere, and so are four and five
  // nodes, whose flat cells are no likeness of the surface: on a ball four end with a mean edge
  // ratio of 1.47 instead of a tetrahedron. From six on, flat cells hold the nodes apart where a
  // grain is long: on an ellipsoid of 1 : 2 : 3 cells on the sphere let 8 to 16 nodes run together
  // on one side (rms distance 46 to 58 % of R at a volume that is exact), flat ones only 8; 12 and
  // 16 come to 12 and 8 %. On compact grains there is no difference.
  constexpr int fewest_flat_cells = 6;
  RelaxationMetric& metric = result.options.relaxation.metric;
  if (options.seeding.sampling != Sampling::Weighted || options.node_count < fewest_flat_cells) {
    metric = RelaxationMetric::Sphere;
  }

  PlacedNodes nodes;
  if (grain.parametrization == Parametrization::Spherical) {
    metric = RelaxationMetric::Surface;
    SpaceNodes in_space =
        place_in_space(grain, prepared.distance ? &*prepared.distance : nullptr, options.node_count,
                       {options.seeding, options.weighting, options.relaxation, options.levels},
                       options.placement, prepared.original.volume, execution.part(0.0, 0.9));
    result.relaxation = std::move(in_space.relaxation);
    result.space = in_space.report;
    nodes = std::move(in_space.placed);
  } else {
    RelaxationResult relaxed = tessellate(grain, result.options, execution.part(0.0, 0.7));
    result.relaxation = std::move(relaxed.report);
    nodes = place_nodes(grain, std::move(relaxed), metric, prepared.original.volume,
                        options.placement, execution.part(0.7, 0.9));
    result.space.mending = nodes.mending;
    result.space.fit = nodes.fit;
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
  if (measures_distances(options)) {
    const Execution measuring = execution.part(0.92, 0.98);
    measuring.report(0.0, "Measuring distances");
    result.distances = measure_distances(result.mesh, grain.mesh, *prepared.distance,
                                         options.measures.distance_sampling, measuring);
    result.vertex_distances = prepared.distance->distances(result.mesh.points, execution);
    result.misfit = result.distances->from_reference.root_mean_square;
  } else {
    // Few enough to cost a twentieth of a run as published, and enough to tell the rms to some per
    // cent: on four samples and three scans, with 100 to 2000 nodes, it was at most 2.4 % off
    // (beside 400,000), 0.7 % in the mean; with twice as many at most 2.0 %.
    constexpr std::size_t misfit_samples = 5000;
    result.misfit = rms_distance(grain.mesh, result.mesh, misfit_samples, execution);
  }

  if (grain.map_series) {
    result.map_degree = grain.map_series->report.degree;
    if (options.measures.coefficients) {
      result.map_coefficients = grain.map_series->map.coefficients();
    }
  }
  result.centre = grain.centre;
  result.input = prepared.input;
  result.handles = prepared.handles;
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

}  // namespace wscvt
