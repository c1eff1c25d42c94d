// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

#include "wscvt/base/option.h"

namespace wscvt {

// How a scan becomes a surface over the sphere, and how that came out.

/// How the grain's surface is laid over the sphere.
enum class Parametrization {
  Auto,       ///< radial where nothing folds and steep_share is at most steep_share_limit, else
              ///< spherical; for nodes on the series radial up to the fold limit
  Radial,     ///< one radius a direction: the published method, for star-shaped grains
  Spherical,  ///< a bijective map of the scan, for any closed surface of genus 0
};

template <>
struct EnumerationTable<Parametrization> {
  static constexpr std::string_view key = "parametrization";
  static constexpr std::string_view subject = "parametrization";
  static constexpr Enumerator<Parametrization> rows[] = {
      {Parametrization::Auto, "auto", "auto",
       "radial where nothing folds and hardly any flank is steep, seen from the centroid, and "
       "spherical elsewhere; the log says which"},
      {Parametrization::Radial, "radial", "radial",
       "one radius in each direction, the published method, for star-shaped grains"},
      {Parametrization::Spherical, "spherical", "spherical",
       "any closed body without handles, hooks and shells too; nodes are relaxed in space, on the "
       "scan itself"},
  };
};

/// A flank is steep where the surface's normal turns from the radius by more than this, in degrees.
inline constexpr double steep_flank_angle = 75.0;

/// Auto takes the radial map up to this share. Gentle grains have none (the project's samples, as
/// rough as they are, and ellipsoids up to 7.5 : 1, whose steepest flank has the tangent
/// (a^2 - b^2) / (2 a b)); the least rough scans of crushed rock, soil grains and stone tools
/// tried have 0.006, others up to 0.08, and bodies with undercuts 0.1 and more.
inline constexpr double steep_share_limit = 0.005;

/// Degree of a series to be fitted; 0 is a sphere.
inline constexpr NumberOption<int> fit_degree_option = {"degree", "degree of the fit", 0, 60};

/// Takes the place of the degree where it is to follow the grain, see fit_harmonics_for_nodes.
inline constexpr int automatic_degree = 0;

/// Of a series that stands for a grain.
inline constexpr NumberOption<int> harmonic_degree_option = {
    "degree",
    "harmonic degree",
    automatic_degree,
    fit_degree_option.maximum,
    Ends::Both,
    "of the series fitted to the scan; 0: the lowest whose series misses the scan by less than "
    "flat triangles between so many nodes do, or the best there is"};

/// Share of the solid angle in sheets beyond the first, in %, up to which a body is taken for one
/// with a radius in each direction unless another limit is given: its outermost layer stands in for
/// it. Fold counts as in folded_solid_angle.
inline constexpr double usual_fold_limit_percent = 5.0;

/// How a scan becomes a surface over the sphere.
struct SurfaceOptions {
  Parametrization parametrization = Parametrization::Auto;
  int degree = automatic_degree;  ///< of the harmonic series, see harmonic_degree_option
  /// Refuse above this folded_solid_angle; Radial only.
  double fold_limit_percent = usual_fold_limit_percent;
};

inline constexpr NumberOption<double> fold_limit_option = {
    "fold-limit", "fold limit in %",
    0.0,          99.0,
    Ends::Both,   "the scan is refused when sheets beyond the first fill more of the solid angle"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_surface_options(const SurfaceOptions& options);

/// Why a series has no higher degree.
enum class DegreeLimit {
  None,       ///< it has the degree asked for, or one that is close enough
  Points,     ///< fewer than two points a coefficient
  Condition,  ///< the points are spread too unevenly to tell the coefficients apart
  Radius,   ///< of higher degree the series is not positive everywhere: a long, flat or sharp body
  Highest,  ///< none is close enough, and this is the highest that is fitted
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
      {DegreeLimit::Highest, "highest", "the highest there is"},
  };
};

/// How the fit of a series went.
struct HarmonicFitReport {
  int requested_degree = 0;  ///< or automatic_degree
  int degree = 0;  ///< lowered when the series of the requested one is not positive everywhere
  DegreeLimit limit = DegreeLimit::None;
  std::size_t rays = 0;  ///< directions in which the surface was read; 0: nothing was fitted
  /// Root mean square, over the area of the surface, of the distance from it to the series; length.
  double residual = 0.0;
  double smallest_radius = 0.0;  ///< of the series on a fine grid, length, > 0
  double chord_error = 0.0;      ///< what an automatic degree was to stay below, length; else 0
};

/// How a map to the sphere came out. Distortions are those of the triangles of the mesh whose area
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
