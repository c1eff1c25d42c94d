// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/pi.h"
#include "wscvt/tessellation/tabulated_surface.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

// What a weighting is to the seed model. Each weighting is one function in a file of its own; a new
// one is such a file, a value with its row in tessellation_options.h, and its place in
// weighting_rule.cpp.

/// Largest alpha x of eq. 11, whose weight is then 3.6 / N: 3.118 times that is 0.89 of the mean
/// cell, so that no cell is wanted smaller than nothing. Beyond it seeds lose their cells (measured
/// above alpha 1.25).
inline constexpr double curvature_clip = 0.9;

/// Curvatures below this, in 1 / equivalent radius, are taken as this by what takes a logarithm: a
/// flat face has no scale of its own.
inline constexpr double flat_curvature = 0.01;

/// Mean and standard deviation of a field over seeds.
struct FieldDeviation {
  double mean = 0.0;
  double deviation = 0.0;
};

/// What a weighting makes of a surface.
struct WeightingRule {
  /// What a seed's weight depends on, at the nodes of the grid; empty when all seeds weigh alike.
  std::vector<double> field;
  /// Points along a side from which the field is interpolated: 6 for what varies as the surface
  /// does, 4 for what is smoothed over cells.
  int stencil = 4;
  /// The weight, in steradian, of one of `count` seeds where the field has a value.
  std::function<double(double value, double count, const FieldDeviation& over_seeds)> weight;
  bool reads_deviation = false;  ///< whether `weight` reads `over_seeds`
};

/// Of Weighting::Constant: equal solid angles.
WeightingRule constant_weighting(const TabulatedSurface& table, const WeightingOptions& options,
                                 const Execution& execution);

/// Of Weighting::RadialDistance: WSCVT-D, the paper's eq. 10.
WeightingRule radial_distance_weighting(const TabulatedSurface& table,
                                        const WeightingOptions& options,
                                        const Execution& execution);

/// Of Weighting::Curvature: WSCVT-C, the paper's eqs. 11 to 14.
WeightingRule curvature_weighting(const TabulatedSurface& table, const WeightingOptions& options,
                                  const Execution& execution);

/// Of Weighting::Area: equal surface areas.
WeightingRule area_weighting(const TabulatedSurface& table, const WeightingOptions& options,
                             const Execution& execution);

/// The rule of options.kind for a surface.
WeightingRule weighting_rule(const TabulatedSurface& table, const WeightingOptions& options,
                             const Execution& execution);

}  // namespace wscvt
