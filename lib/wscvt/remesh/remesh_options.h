// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/nodes/scan_nodes_options.h"
#include "wscvt/remesh/error_target.h"
#include "wscvt/repair/scan_options.h"
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
       "Voronoi cells on the grain's own surface; nodes fitted to the scan, with exactly its "
       "volume; for any closed grain"},
      {Method::AsPublished, "as-published", "as published",
       "method of Wu, Huang and Lai 2022: Voronoi cells on the unit sphere, nodes on a "
       "spherical-harmonic surface; for star-shaped grains"},
  };
};

template <>
struct EnumerationTable<CellWeighting> {
  static constexpr std::string_view key = "weighting";
  static constexpr std::string_view subject = "weighting";
  static constexpr Enumerator<CellWeighting> rows[] = {
      {CellWeighting::Area, "wscvt-d", "WSCVT-D (equal areas)",
       "cells of equal area, for triangles of even size"},
      {CellWeighting::Curvature, "wscvt-c", "WSCVT-C (curvature)",
       "smaller cells where the surface bends"},
  };
};

/// Placement of the nodes relative to the scan.
enum class ScanPlacement {
  Fitted,      ///< off it; the triangles are closest to it and enclose exactly its volume
  OnSurface,   ///< on it
  ContactFit,  ///< off it; contacts found by the deepest node are where the scan's would be
};

template <>
struct EnumerationTable<ScanPlacement> {
  static constexpr std::string_view key = "placement";
  static constexpr std::string_view subject = "node placement";
  static constexpr Enumerator<ScanPlacement> rows[] = {
      {ScanPlacement::Fitted, "fitted", "fitted (volume exact)",
       "near the grain's surface, so that the triangles are closest to it and enclose exactly its "
       "volume"},
      {ScanPlacement::OnSurface, "on-surface", "on the surface",
       "exactly on the grain's surface, for contact laws that sum over nodes by area"},
      {ScanPlacement::ContactFit, "contact-fit", "contact fit",
       "near the grain's surface, so that contact starts at the correct distance on average; for "
       "contact laws that use the deepest node. The volume differs from the scan's"},
  };
};

/// Options of the method OnScan, which remeshes any closed grain by the same steps.
struct OnScanOptions {
  CellWeighting weighting = CellWeighting::Area;
  double curvature_alpha = 1.0;  ///< strength of CellWeighting::Curvature, -3 to 3
  ScanPlacement placement = ScanPlacement::Fitted;
  /// Radius of the balls that ContactFit puts on the scan, equivalent radii, in (0, 100]. These
  /// values give the smallest mean error of a first contact (tests/figures/study/contacts.md): 0.4
  /// for nodes against the surface of another grain, 1.3 for nodes of both grains, 5 for flat
  /// walls.
  double contact_radius = 0.4;
  /// Wanted mean of longest / shortest edge of a triangle, 1.08 to 1.6: small values give even
  /// triangles, large values a mesh closer to the scan.
  double edge_ratio = default_edge_ratio;
  HandleOptions handles;
};

inline constexpr NumberOption<double> contact_radius_option = {
    "contact-radius",
    "ball radius of the contact fit",
    0.0,
    100.0,
    Ends::NotMinimum,
    "in equivalent radii. Use 0.4 for nodes against another grain's surface, 1.3 for nodes of both "
    "grains, 5 for flat walls"};
inline constexpr NumberOption<double> edge_ratio_option = {
    "edge-ratio",
    "mean edge ratio",
    least_edge_ratio,
    most_edge_ratio,
    Ends::Both,
    "wanted mean of longest / shortest edge. Small: even triangles; large: closer to scan"};

/// Placement of the nodes along their directions.
enum class PublishedPlacement {
  Series,   ///< on the spherical-harmonic surface, as in the paper
  Surface,  ///< on the scan, where the ray from the centroid leaves it
};

template <>
struct EnumerationTable<PublishedPlacement> {
  static constexpr std::string_view key = "placement";
  static constexpr std::string_view subject = "node placement";
  static constexpr Enumerator<PublishedPlacement> rows[] = {
      {PublishedPlacement::Series, "sh-surface", "SH surface",
       "on the spherical-harmonic surface, without scanning noise"},
      {PublishedPlacement::Surface, "on-surface", "on the surface",
       "exactly on the grain's surface, where the ray from the centroid leaves it"},
  };
};

/// Options of the method AsPublished: only the steps of the paper.
struct AsPublishedOptions {
  Sampling sampling = Sampling::Weighted;
  Weighting weighting = Weighting::RadialDistance;
  double curvature_alpha = 1.0;  ///< alpha of eq. 11, -3 to 3
  PublishedPlacement placement = PublishedPlacement::Series;
  /// The scan is refused above this overhang fraction (overhang_solid_angle), in %.
  double max_overhang_percent = usual_overhang_limit_percent;
};

inline constexpr NumberOption<double> max_overhang_option = {
    "max-overhang",
    "max. overhang in % of the solid angle",
    0.0,
    99.0,
    Ends::Both,
    "refuse the scan if rays from its centroid meet more surface than this behind their first hit"};

/// Measures beyond descriptors and quality.
struct MeasureOptions {
  bool distances = false;        ///< fill RemeshResult::distances and vertex_distances
  bool node_curvatures = false;  ///< fill RemeshResult::curvatures
  bool repaired_scan = false;    ///< fill RemeshResult::repaired_scan
  /// Fits RemeshResult::coefficients to a scan that is remeshed on the scan, to the degree of the
  /// options. It is called with the repaired scan, its handles cut, centred and of equivalent
  /// radius
  /// 1. `scan_harmonics` of toolbox/map fits any grain without handles, `radial_coefficients` of
  /// harmonic_surface.h one without overhangs. Empty: no coefficients on the scan.
  std::function<SeriesCoefficients(const IndexedMesh&, int degree, const Execution&)> series;
  /// Returns the mesh to be written, if coordinates are rounded or rotated before writing.
  /// Self-intersections are counted on this mesh. Empty: the result's own mesh.
  std::function<IndexedMesh(const RemeshResult&)> written;
};

/// All options of a remesh: those of one method, and the common ones.
struct RemeshOptions {
  int node_count = 1000;  ///< N; with an allowed error the first N tried
  std::variant<OnScanOptions, AsPublishedOptions> method;
  ErrorTarget target;
  /// Ignore the scan's faces and build a surface from its points (see mesh_of_points). If false, a
  /// scan without faces is refused.
  bool points = false;
  ShrinkWrapOptions shrink_wrap;
  /// Max. fraction of the scan's area that repairs may change, in %, 0 to 100.
  double max_repaired_area_percent = MeshCheckOptions().repaired_area_limit_percent;
  /// Degree of the SH series. AsPublished uses it for the surface, OnScan only for
  /// `measures.series`.
  int degree = usual_harmonic_degree;
  MeasureOptions measures;
};

/// Returns the method of the options.
inline Method method_of(const RemeshOptions& options) {
  return options.method.index() == 0 ? Method::OnScan : Method::AsPublished;
}

inline constexpr FlagOption points_option = {
    "points", "ignore faces",
    "and build a star-shaped surface from the points. Without this option a scan without faces is "
    "an error"};
inline constexpr FlagOption distances_option = {"distances", "measure distances",
                                                "from remesh to scan and back, and report them"};
/// Calls `visitor` for each option of one method, with a number and its NumberOption, or with an
/// enumeration. `options` may be const.
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

/// Calls `visitor` for each option that both methods have, also with a flag and its FlagOption.
template <class Options, class Visitor>
void for_each_common_option(Options& options, Visitor& visitor) {
  visitor(options.node_count, node_count_option);
  visitor(options.target.percent, error_target_option);
  visitor(options.target.measure);
  visitor(options.degree, harmonic_degree_option);
  visitor(options.points, points_option);
  visitor(options.shrink_wrap.opening_percent, shrink_wrap_option);
  visitor(options.max_repaired_area_percent, repaired_area_limit_option);
  visitor(options.measures.distances, distances_option);
}

/// Calls `visitor` for every option that changes a remesh or its report: with a number and its
/// NumberOption, with a flag and its FlagOption, or with an enumeration. `options` are
/// RemeshOptions, const or not. Reports, the program and Python use this function. The method is
/// visited first. If the visitor changes it, the options of the new method follow.
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

/// Use of a remesh. Some options have no effect on a surface that is known exactly. Convex parts
/// need only the number of nodes and the options of the scan's repair.
enum class Remeshed { Scan, Surface, Parts };

/// Whether users may set the option of this key.
bool is_option_of(std::string_view key, Remeshed remeshed);

/// Throws Error(InvalidInput), with the range, for options out of range or at odds with each other.
void check_options(const RemeshOptions& options);

/// Returns a sentence for an option that the method does not have but the other method has: that it
/// belongs to the other method, and what to do. Empty for any other key.
Sentence refusal_of_option(std::string_view key, Method method);

/// Returns such a sentence for a value of an option, or for a weighting that is gone.
Sentence refusal_of_value(std::string_view key, std::string_view value, Method method);

/// If there is an allowed error, makes a number of nodes that the user gave the largest of the
/// search, which then begins with at most the usual number. Otherwise changes nothing.
void limit_search_to_given_nodes(RemeshOptions& options);

/// Returns the options as a user gives them, the inverse of the above: with an allowed error, the
/// number of nodes is the largest of the search. Reports print them, so that a call takes them
/// back.
RemeshOptions as_given(RemeshOptions options);

/// Options as users type them: texts by the options' keys.
using TypedOptions = std::map<std::string, std::string, std::less<>>;

/// Takes the key of an option and what is wrong with it; empty if no method has it. Throws.
using RefuseOption = std::function<void(std::string_view key, const Sentence& refusal)>;

/// Reads the texts into `options`, the method first. A flag is "true" or "false". With an allowed
/// error, a number of nodes is the limit, see limit_search_to_given_nodes.
void read_options(const TypedOptions& typed, RemeshOptions& options, const RefuseOption& refuse);

}  // namespace wscvt
