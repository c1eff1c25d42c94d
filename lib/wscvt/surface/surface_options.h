// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

#include "wscvt/base/option.h"

namespace wscvt {

// How a scan becomes a surface over the sphere, and how that came out.

/// Degree of a series to be fitted; 0 is a sphere.
inline constexpr NumberOption<int> fit_degree_option = {"degree", "degree of the fit", 0, 60};

/// Of a series that stands for a grain: the paper's.
inline constexpr int usual_harmonic_degree = 20;
inline constexpr NumberOption<int> harmonic_degree_option = {
    "degree",
    "degree of the SH series",
    fit_degree_option.minimum,
    fit_degree_option.maximum,
    Ends::Both,
    "as published of the surface that the nodes lie on; on the scan of --coefficients only"};

/// Share of the solid angle in sheets beyond the first, in %, up to which a body is taken for one
/// with a radius in each direction unless another limit is given: its outermost layer stands in for
/// it. Fold counts as in folded_solid_angle.
inline constexpr double usual_fold_limit_percent = 5.0;

/// Why a series has no higher degree.
enum class DegreeLimit {
  None,       ///< it has the degree asked for
  Points,     ///< fewer than two points a coefficient
  Condition,  ///< the points are spread too unevenly to tell the coefficients apart
  Radius,  ///< of higher degree the series is not positive everywhere: a long, flat or sharp body
};

template <>
struct EnumerationTable<DegreeLimit> {
  static constexpr std::string_view key = "degree-limit";
  static constexpr std::string_view subject = "limit of the degree";
  static constexpr Enumerator<DegreeLimit> rows[] = {
      {DegreeLimit::None, "none", "as asked for"},
      {DegreeLimit::Points, "points", "the points carry no more"},
      {DegreeLimit::Condition, "condition", "the points are spread too unevenly for more"},
      {DegreeLimit::Radius, "radius", "above it the series is not positive everywhere"},
  };
};

/// Report of the fit of a series.
struct HarmonicFitReport {
  int requested_degree = 0;
  int degree = 0;  ///< lowered when the series of the requested one is not positive everywhere
  DegreeLimit limit = DegreeLimit::None;
  std::size_t rays = 0;  ///< directions in which the surface was read; 0: nothing was fitted
  /// Root mean square, over the area of the surface, of the distance from it to the series; length.
  double residual = 0.0;
  double smallest_radius = 0.0;  ///< of the series on a fine grid, length, > 0
};

/// Report of a map to the sphere. Distortions are those of the triangles of the mesh whose area
/// is not zero.
struct SphereMapReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  int levels = 0;
  int sweeps = 0;                   ///< over all levels
  std::size_t clipped_kernels = 0;  ///< vertices put into the centroid of their ring's kernel
  std::size_t mended_kernels = 0;   ///< vertices whose ring had to be widened first
  /// (s1 / s2 + s2 / s1) / 2 of the stretches s1, s2 of a triangle: 1 where angles are kept.
  /// The mean is taken over the area.
  double mean_angle_distortion = 1.0;
  double largest_angle_distortion = 1.0;
  /// (Area on the sphere / 4 pi) / (area on the surface / its total): 1 where areas are kept.
  double smallest_area_ratio = 1.0;
  double largest_area_ratio = 1.0;
  /// Symmetric Dirichlet energy over that of an isometry, mean over the area: >= 1.
  double energy = 1.0;
};

}  // namespace wscvt
