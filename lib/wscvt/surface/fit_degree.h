// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

#include "wscvt/base/option.h"

namespace wscvt {

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

/// How the fit went.
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

}  // namespace wscvt
