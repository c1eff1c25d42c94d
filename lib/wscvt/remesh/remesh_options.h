// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>
#include <type_traits>
#include <variant>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/nodes/scan_nodes_options.h"
#include "wscvt/scan/scan_options.h"
#include "wscvt/surface/surface_options.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

struct RemeshResult;

/// Method that finds the nodes. Each method has its own options.
enum class Method {
  OnScan,       ///< cells on the grain's own surface, see OnScanOptions
  AsPublished,  ///< the paper's: cells on the unit sphere, see AsPublishedOptions
};

template <>
struct EnumerationTable<Method> {
  static constexpr std::string_view key = "method";
  static constexpr std::string_view subject = "method";
  static constexpr Enumerator<Method> rows[] = {
      {Method::OnScan, "on-scan", "on the scan",
       "Voronoi cells on the grain's own surface, nodes fitted to the scan, exactly its volume; "
       "any "
       "closed grain"},
      {Method::AsPublished, "as-published", "as published",
       "Wu, Huang and Lai 2022: Voronoi cells on the unit sphere, nodes on a spherical-harmonic "
       "surface; star-shaped grains"},
  };
};

template <>
struct EnumerationTable<CellWeighting> {
  static constexpr std::string_view key = "weighting";
  static constexpr std::string_view subject = "weighting";
  static constexpr Enumerator<CellWeighting> rows[] = {
      {CellWeighting::Area, "wscvt-d", "WSCVT-D (equal areas)",
       "cells of equal area, so triangles of even size"},
      {CellWeighting::Curvature, "wscvt-c", "WSCVT-C (curvature)",
       "smaller cells where the surface bends"},
      {CellWeighting::ErrorAdaptive, "error-adaptive", "error-adaptive",
       "smaller cells where flat triangles miss the surface most"},
  };
};

/// Placement of the nodes relative to the scan.
enum class ScanPlacement {
  Fitted,      ///< off it, so that the triangles are nearest to it and enclose exactly its volume
  OnSurface,   ///< on it
  ContactFit,  ///< off it, so that contacts found by the deepest node are where the scan's would be
};

template <>
struct EnumerationTable<ScanPlacement> {
  static constexpr std::string_view key = "placement";
  static constexpr std::string_view subject = "node placement";
  static constexpr Enumerator<ScanPlacement> rows[] = {
      {ScanPlacement::Fitted, "fitted", "fitted (volume exact)",
       "off the scan, so that the triangles are closest to it and enclose exactly its volume"},
      {ScanPlacement::OnSurface, "on-surface", "on the surface",
       "on the scan itself, for contact laws that sum over nodes by area"},
      {ScanPlacement::ContactFit, "contact-fit", "contact fit",
       "off the scan, so that on average contact starts at the correct distance, for contact laws "
       "that use the deepest node; the volume differs from the scan's"},
  };
};

/// The method OnScan. Any closed grain is remeshed by the same steps.
struct OnScanOptions {
  CellWeighting weighting = CellWeighting::Area;
  double curvature_alpha = 1.0;  ///< strength of CellWeighting::Curvature, -3 to 3
  ScanPlacement placement = ScanPlacement::Fitted;
  /// Of the balls that ContactFit lays to the scan, equivalent radii, in (0, 100]. At these the
  /// mean error of a first contact is least (tests/study/contacts.md): 0.4 for nodes against the
  /// surface of another grain, 1.3 where the nodes of both grains are looked at, 5 for flat walls.
  double contact_radius = 0.4;
  /// Wanted mean of longest / shortest edge of a triangle, 1.08 to 1.7: small values give even
  /// triangles, large ones come closer to the scan.
  double edge_ratio = default_edge_ratio;
  HandleOptions handles;
};

inline constexpr NumberOption<double> contact_radius_option = {
    "contact-radius",
    "ball radius of the contact fit",
    0.0,
    100.0,
    Ends::NotMinimum,
    "in equivalent radii; 0.4 for nodes against another grain's surface, 1.3 if the nodes of both "
    "grains are used, 5 for flat walls"};
inline constexpr NumberOption<double> edge_ratio_option = {
    "edge-ratio",
    "mean edge ratio",
    least_edge_ratio,
    most_edge_ratio,
    Ends::Both,
    "wanted mean of longest / shortest edge: small is even, large is closer to the "
    "scan"};

/// Placement of the nodes along their directions.
enum class PublishedPlacement {
  Series,   ///< on the spherical-harmonic surface: the paper's
  Surface,  ///< on the scan, where the ray from the centroid leaves it
};

template <>
struct EnumerationTable<PublishedPlacement> {
  static constexpr std::string_view key = "placement";
  static constexpr std::string_view subject = "node placement";
  static constexpr Enumerator<PublishedPlacement> rows[] = {
      {PublishedPlacement::Series, "sh-surface", "SH surface",
       "on the spherical-harmonic surface, which is free of scanning noise"},
      {PublishedPlacement::Surface, "on-surface", "on the surface",
       "on the scan itself, where rays from the centroid leave it"},
  };
};

/// The method AsPublished: the paper's steps and nothing else.
struct AsPublishedOptions {
  Sampling sampling = Sampling::Weighted;
  Weighting weighting = Weighting::RadialDistance;
  double curvature_alpha = 1.0;  ///< alpha of eq. 11, -3 to 3
  PublishedPlacement placement = PublishedPlacement::Series;
  /// The scan is refused above this overhang fraction (folded_solid_angle), in %.
  double max_overhang_percent = usual_fold_limit_percent;
};

inline constexpr NumberOption<double> max_overhang_option = {
    "max-overhang",
    "max. overhang in % of the solid angle",
    0.0,
    99.0,
    Ends::Both,
    "the scan is refused if rays from its centroid meet more surface than this "
    "behind the first"};

/// Measures beyond descriptors and quality.
struct MeasureOptions {
  bool distances = false;        ///< fill RemeshResult::distances and vertex_distances
  bool node_curvatures = false;  ///< fill RemeshResult::curvatures
  bool coefficients = false;     ///< fill RemeshResult::coefficients, also on the scan
  bool repaired_scan = false;    ///< fill RemeshResult::repaired_scan
  bool suggestions = true;  ///< fill RemeshResult::suggestions where the remesh is not accurate
  /// The mesh that is made of a result, where coordinates are rounded or turned before they are
  /// written: its self-intersections are those that are counted. Empty: the result's own mesh.
  std::function<IndexedMesh(const RemeshResult&)> written;
};

/// Everything a caller may choose: what both methods need, and the options of one of them. The
/// defaults work.
struct RemeshOptions {
  int node_count = 1000;  ///< N; with an error target the first N tried
  std::variant<OnScanOptions, AsPublishedOptions> method;
  ErrorTarget target;
  /// Take the scan's points only and make its surface anew from them (see mesh_of_points); faces
  /// that it has are not used. Without it a scan without faces is refused.
  bool points = false;
  EnvelopeOptions envelope;
  /// Max. fraction of the scan's area that repairs may change, in %, 0 to 100.
  double max_repaired_area_percent = MeshCheckOptions().mended_area_limit_percent;
  /// Of the SH series: as published of the surface, on the scan of the coefficients that
  /// `measures.coefficients` asks for.
  int degree = usual_harmonic_degree;
  MeasureOptions measures;
};

/// The method whose options are held.
inline Method method_of(const RemeshOptions& options) {
  return options.method.index() == 0 ? Method::OnScan : Method::AsPublished;
}

inline constexpr FlagOption points_option = {
    "points", "ignore faces",
    "and build a star-shaped surface from the points; without it a scan without faces is refused"};
inline constexpr FlagOption distances_option = {"distances", "measure distances",
                                                "to the scan, both ways, and report them"};
inline constexpr FlagOption suggestions_option = {
    "suggestions", "suggest better settings",
    "if the remesh is not accurate: another setting is tried at no more cost than the run, and "
    "named if it is better"};

/// Calls `visitor` for the options of one method, with a number and its NumberOption or
/// with an enumeration, which has its table. `options` may be const.
template <class Options, class Visitor>
void for_each_method_option(Options& options, Visitor& visitor) {
  visitor(options.weighting);
  visitor(options.curvature_alpha, curvature_alpha_option);
  visitor(options.placement);
  if constexpr (std::is_same_v<std::remove_const_t<Options>, OnScanOptions>) {
    visitor(options.edge_ratio, edge_ratio_option);
    visitor(options.contact_radius, contact_radius_option);
    visitor(options.handles.action);
    visitor(options.handles.length_limit, max_handle_loop_option);
  } else {
    visitor(options.sampling);
    visitor(options.max_overhang_percent, max_overhang_option);
  }
}

/// Calls `visitor` for the options that both methods have, likewise.
template <class Options, class Visitor>
void for_each_common_option(Options& options, Visitor& visitor) {
  visitor(options.node_count, node_count_option);
  visitor(options.target.percent, error_target_option);
  visitor(options.target.measure);
  visitor(options.target.largest_node_count, largest_node_count_option);
  visitor(options.degree, harmonic_degree_option);
  visitor(options.points, points_option);
  visitor(options.envelope.opening_percent, envelope_option);
  visitor(options.max_repaired_area_percent, mended_area_limit_option);
  visitor(options.measures.distances, distances_option);
  visitor(options.measures.suggestions, suggestions_option);
}

/// Calls `visitor` for every option of a remesh that its result or its report follows: with a
/// number and its NumberOption, with a flag and its FlagOption, or with an enumeration, which has
/// its table. `options` are RemeshOptions, const or not. Reports, the program and Python go through
/// here. A visitor that changes the method, which comes first, gets the options of the new one.
template <class Options, class Visitor>
void for_each_option(Options& options, Visitor& visitor) {
  Method method = method_of(options);
  visitor(method);
  if constexpr (!std::is_const_v<Options>) {
    if (method != method_of(options)) {
      if (method == Method::OnScan) options.method = OnScanOptions();
      if (method == Method::AsPublished) options.method = AsPublishedOptions();
    }
  }
  std::visit([&](auto& of_method) { for_each_method_option(of_method, visitor); }, options.method);
  for_each_common_option(options, visitor);
}

/// Throws Error(InvalidInput), with the range, for options out of range or at odds with each other.
void check_options(const RemeshOptions& options);

}  // namespace wscvt
