// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/numbers.h"
#include "wscvt/surface/sphere_surface.h"
#include "wscvt/tessellation/cap_sums.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// Surface quantities for the weightings, at the nodes of an equal-angle grid. Each is computed on
/// first use, because derivatives cost three times as much as distances. Not thread-safe.
class TabulatedSurface {
 public:
  /// For `node_count` seeds. The surface must outlive the table.
  TabulatedSurface(const SphereSurface& surface, int node_count, const Execution& execution);

  const SphereSurface& surface() const { return surface_; }
  int node_count() const { return node_count_; }
  int rows() const;  ///< of the grid
  /// Returns distances from the origin to the surface at the grid's nodes; the radii of a radial
  /// surface.
  const std::vector<double>& distances() const;
  const GridField& area_elements() const;  ///< dA/dOmega at the grid's nodes
  /// Returns S, the surface's area: from the area elements if they were computed, else by
  /// quadrature; both within 1e-3.
  double area() const;
  /// Returns the radius of the sphere of the same area.
  double radius() const { return std::sqrt(area() / (4.0 * pi)); }

 private:
  const SphereSurface& surface_;
  int node_count_;
  Execution execution_;
  mutable std::vector<double> distances_;
  mutable std::optional<GridField> area_elements_;
};

// The rule by which a weighting gives weights to the seed model. Each weighting is one function.
// To add one, add a function and its entry in weighting_rule.cpp, and a value with its row in
// tessellation_options.h.

/// Largest alpha x of eq. 11. Its weight is 3.6 / N, and 3.118 times this is 0.89 of the mean cell,
/// so that no wanted cell is negative. Beyond it seeds lose their cells (measured above alpha
/// 1.25).
inline constexpr double curvature_clip = 0.9;

/// Curvatures below this, in 1 / equivalent radius, are raised to it before a logarithm, because a
/// flat face has no scale.
inline constexpr double flat_curvature = 0.01;

/// Mean and standard deviation of a field over seeds.
struct FieldDeviation {
  double mean = 0.0;
  double deviation = 0.0;
};

/// The weights that a weighting gives on a surface.
struct WeightingRule {
  /// The quantity that decides a seed's weight, at the nodes of the grid; empty if all weights are
  /// equal.
  std::vector<double> field;
  /// Points along a side for interpolating the field: 6 if it varies as the surface does, 4 if it
  /// is smoothed over cells.
  int stencil = 4;
  /// Returns the weight, in steradian, of one of `count` seeds at a value of the field.
  std::function<double(double value, double count, const FieldDeviation& over_seeds)> weight;
  bool reads_deviation = false;  ///< whether `weight` reads `over_seeds`
};

/// Returns the rule of options.kind for a surface.
WeightingRule weighting_rule(const TabulatedSurface& table, const WeightingOptions& options,
                             const Execution& execution);

}  // namespace wscvt
