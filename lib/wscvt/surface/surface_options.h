// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "wscvt/base/option.h"

namespace wscvt {

// Options and reports of the surface over the sphere that is made of a scan.

/// Degree of a fitted series; 0 is a sphere.
inline constexpr NumberOption<int> fit_degree_option = {"degree", "degree of the fit", 0, 60};

/// Default degree of a grain's series, as in the paper.
inline constexpr int usual_harmonic_degree = 20;
inline constexpr NumberOption<int> harmonic_degree_option = {
    "degree",
    "degree of the SH series",
    fit_degree_option.minimum,
    fit_degree_option.maximum,
    Ends::Both,
    "of the surface that carries the nodes (as-published), of the coefficients file only "
    "(on-scan)"};

/// Default limit of the overhang fraction (overhang_solid_angle), in % of the solid angle. Up to it
/// a body is treated as star-shaped, and its outermost surface replaces it.
inline constexpr double usual_overhang_limit_percent = 5.0;

/// Reason why a series has no higher degree.
enum class DegreeLimit {
  None,    ///< it has the requested degree
  Radius,  ///< at a higher degree the series is not positive everywhere: a long, flat or sharp body
};

template <>
struct EnumerationTable<DegreeLimit> {
  static constexpr std::string_view key = "degree-limit";
  static constexpr std::string_view subject = "limit of the degree";
  static constexpr Enumerator<DegreeLimit> rows[] = {
      {DegreeLimit::None, "none", "as requested"},
      {DegreeLimit::Radius, "radius", "a series of higher degree is not positive everywhere"},
  };
};

/// Report of the fit of a series.
struct HarmonicFitReport {
  int requested_degree = 0;
  int degree = 0;  ///< lower than requested if that series is not positive everywhere
  DegreeLimit limit = DegreeLimit::None;
  std::size_t rays = 0;  ///< directions in which the surface was sampled; 0: no fit
  /// Rms distance from the surface to the series, over the area of the surface; length.
  double residual = 0.0;
  double smallest_radius = 0.0;  ///< of the series on a fine grid, length, > 0
};

/// Coefficients of an SH series about the origin or about a result's centre, length. The series is
/// of the radius if rays from there see the whole grain, else of x, y and z (see HarmonicMap).
struct SeriesCoefficients {
  std::vector<double> radius;
  std::array<std::vector<double>, 3> map;
};

}  // namespace wscvt
