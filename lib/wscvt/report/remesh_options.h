// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "wscvt/base/option.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/scan/scan_options.h"
#include "wscvt/surface/surface_options.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// What a remesh keeps to.
enum class Method {
  OnScan,       ///< every stage as chosen; by default what keeps the scan's shape best
  AsPublished,  ///< the paper's: see with_method
};

template <>
struct EnumerationTable<Method> {
  static constexpr std::string_view key = "method";
  static constexpr std::string_view subject = "method";
  static constexpr Enumerator<Method> rows[] = {
      {Method::OnScan, "on-scan", "on the scan",
       "even triangles that follow the scan itself, with exactly its volume"},
      {Method::AsPublished, "as-published", "as published",
       "Wu, Huang and Lai 2022: nodes on a harmonic series, with cells on the sphere; map, metric, "
       "placement and refinement are set for that"},
  };
};

/// What is measured beyond descriptors and quality.
struct MeasureOptions {
  bool distances = false;  ///< fill RemeshResult::distances and vertex_distances
  DistanceOptions distance_sampling;
  bool node_curvatures = false;  ///< fill RemeshResult::curvatures
  bool coefficients = false;     ///< fill RemeshResult::map_coefficients of a Spherical one
  bool used_scan = false;        ///< fill RemeshResult::used_scan
  bool advice = true;            ///< fill RemeshResult::tried where the remesh misses the scan
};

/// Everything a caller may choose, stage by stage; the defaults work.
struct RemeshOptions {
  int node_count = 1000;  ///< N; with an error target the first N tried
  Method method = Method::OnScan;
  ErrorTarget target;
  /// Take the scan's points alone and make its surface anew from them (see mesh_of_points); faces
  /// that it has are not used. Without it a scan without faces is refused.
  bool points = false;
  EnvelopeOptions envelope;
  MeshCheckOptions check;
  HandleOptions handles;
  SurfaceOptions surface;
  SeedingOptions seeding;
  WeightingOptions weighting;
  RelaxationOptions relaxation;
  MultilevelOptions levels;
  PlacementOptions placement;
  MeasureOptions measures;
};

inline constexpr FlagOption points_option = {
    "points", "points of the scan",
    "taken alone, and a surface made of them; without it a scan without faces is refused"};
inline constexpr FlagOption distances_option = {"distances", "distances to the scan",
                                                "measured and reported"};

inline constexpr FlagOption advice_option = {
    "advice", "advice",
    "where the remesh misses the scan: other settings are tried and the best two are named"};

/// Calls `visitor` for every option of a remesh that its result or its report follows: with a
/// number and its NumberOption, with a flag and its FlagOption, or with an enumeration, which has
/// its table. `options` are RemeshOptions, const or not. Reports and the program go through here.
template <class Options, class Visitor>
void for_each_option(Options& options, Visitor& visitor) {
  visitor(options.node_count, node_count_option);
  visitor(options.method);
  visitor(options.target.percent, error_target_option);
  visitor(options.target.measure);
  visitor(options.target.largest_node_count, largest_node_count_option);
  visitor(options.seeding.sampling);
  visitor(options.weighting.kind);
  visitor(options.weighting.curvature_alpha, curvature_alpha_option);
  visitor(options.weighting.curvature_source);
  visitor(options.weighting.adaptive_exponent, adaptive_exponent_option);
  visitor(options.surface.degree, harmonic_degree_option);
  visitor(options.surface.parametrization);
  visitor(options.surface.fold_limit_percent, fold_limit_option);
  visitor(options.points, points_option);
  visitor(options.envelope.opening_percent, envelope_option);
  visitor(options.relaxation.metric);
  visitor(options.placement.kind);
  visitor(options.placement.contact_radius, contact_radius_option);
  visitor(options.placement.refuse_self_intersections, refuse_self_intersections_option);
  visitor(options.placement.refinement.rounds, refinement_rounds_option);
  visitor(options.placement.refinement.smallest_angle, refinement_angle_option);
  visitor(options.placement.refinement.tolerance, refinement_tolerance_option);
  visitor(options.seeding.start);
  visitor(options.seeding.random_seed, random_seed_option);
  visitor(options.relaxation.maximum_iterations, maximum_iterations_option);
  visitor(options.relaxation.displacement_tolerance, displacement_tolerance_option);
  visitor(options.relaxation.area_tolerance, area_tolerance_option);
  visitor(options.relaxation.acceleration, acceleration_option);
  visitor(options.relaxation.over_relaxation, over_relaxation_option);
  visitor(options.levels.coarsest_seeds, coarsest_seeds_option);
  visitor(options.levels.coarsest_tolerance, coarsest_tolerance_option);
  visitor(options.levels.middle_tolerance, middle_tolerance_option);
  visitor(options.measures.distances, distances_option);
  visitor(options.measures.distance_sampling.samples, distance_samples_option);
  visitor(options.measures.advice, advice_option);
  visitor(options.check.weld_tolerance, weld_tolerance_option);
  visitor(options.check.mended_area_limit_percent, mended_area_limit_option);
  visitor(options.check.dropped_volume_limit, dropped_volume_limit_option);
  visitor(options.handles.length_limit, handle_length_option);
  visitor(options.handles.count_limit, handle_count_option);
}

/// The options with what their method sets. AsPublished: a series of degree 20 (where the degree is
/// not given) over the radial map, cells on the sphere, nodes on the series, no refinement.
RemeshOptions with_method(RemeshOptions options);

/// Throws Error(InvalidInput), with the range, for options out of range or at odds with each other.
void check_options(const RemeshOptions& options);

}  // namespace wscvt
