// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "wscvt/base/option.h"

namespace wscvt {

/// What a seed weighs, and so how large its cell becomes: w in steradian, for N seeds on a surface
/// of area S, at radius r and area per solid angle g = dA/dOmega. The paper is that of remesh.h.
enum class Weighting {
  Constant,        ///< equal solid angles
  RadialDistance,  ///< WSCVT-D, eq. 10 as printed: w = S / (N pi r^2)
  Curvature,       ///< WSCVT-C, eqs. 11 to 14: more nodes where curvature is high
  Area,            ///< equal surface areas, ours: w = S / (3.118 N g), as cells are 3.118 w + C
  /// Nodes where flat triangles err most, ours: node density g k^(2/3), k the curvature. Curvatures
  /// below 0.3 of their median count as that, so that flat faces keep nodes enough to be seen as
  /// flat.
  ErrorAdaptive,
};

template <>
struct EnumerationTable<Weighting> {
  static constexpr std::string_view key = "weighting";
  static constexpr std::string_view subject = "weighting";
  static constexpr Enumerator<Weighting> rows[] = {
      {Weighting::Constant, "constant", "constant", "equal solid angles"},
      {Weighting::RadialDistance, "radial-distance", "WSCVT-D (radial distance)",
       "smaller solid angles far from the centroid, so even triangles"},
      {Weighting::Curvature, "curvature", "WSCVT-C (curvature)",
       "more nodes where the surface bends"},
      {Weighting::Area, "area", "area", "equal surface areas"},
      {Weighting::ErrorAdaptive, "error-adaptive", "error-adaptive",
       "nodes where flat triangles err most"},
  };
};

/// Which curvature the curvature weighting reads.
enum class CurvatureSource {
  Series,      ///< analytic, from the fitted series
  QuadricFit,  ///< the paper's local quadric fit on the scan (2-ring)
};

template <>
struct EnumerationTable<CurvatureSource> {
  static constexpr std::string_view key = "curvature-source";
  static constexpr std::string_view subject = "source of the curvature";
  static constexpr Enumerator<CurvatureSource> rows[] = {
      {CurvatureSource::Series, "series", "series", "exact derivatives of the fitted surface"},
      {CurvatureSource::QuadricFit, "quadrics", "quadrics on the scan",
       "a quadric fitted around each vertex of the scan over two rings, as in the paper"},
  };
};

/// How cells are weighed.
struct WeightingOptions {
  Weighting kind = Weighting::RadialDistance;
  double curvature_alpha = 1.0;          ///< alpha of eq. 11, -3 to 3
  double adaptive_exponent = 2.0 / 3.0;  ///< of the curvature in ErrorAdaptive, 0 to 1.5
  /// A formula has its own only, and a grain that is mapped whole has no series: quadrics there.
  CurvatureSource curvature_source = CurvatureSource::Series;
};

inline constexpr NumberOption<double> curvature_alpha_option = {
    "alpha",    "strength alpha of the curvature weighting",
    -3.0,       3.0,
    Ends::Both, "0 ignores curvature, larger gathers more nodes where the surface bends"};
inline constexpr NumberOption<double> adaptive_exponent_option = {
    "adaptive-exponent",
    "exponent of the curvature in the error-adaptive weighting",
    0.0,
    1.5,
    Ends::Both,
    "0 gives equal areas"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_weighting_options(const WeightingOptions& options);

}  // namespace wscvt
