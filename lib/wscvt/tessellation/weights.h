// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/surface/radial_surface.h"
#include "wscvt/tessellation/cap_sums.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// A relaxed cell's solid angle is this times its seed's weight, plus a constant that is equal for
/// all seeds: 2 / (5 / (9 sqrt 3)) from the second moment of the regular hexagon.
inline constexpr double cell_area_per_weight = 3.118;

/// Smallest cell, as a fraction of the mean cell, for which this law is used; no cell is wanted
/// smaller.
inline constexpr double smallest_cell_share = 0.05;

/// Weights of seeds at any position, for the relaxation. One value per seed, in their order.
class SeedModel {
 public:
  virtual ~SeedModel() = default;

  /// Computes power weights in steradian for the seeds; empty if all are equal.
  virtual void weights(const std::vector<Vector3>& seeds, const Execution& execution,
                       std::vector<double>& result) const = 0;
};

/// Surface quantities for the weightings, at the nodes of an equal-angle grid. Each is computed on
/// first use, because derivatives cost three times as much as radii. Not thread-safe.
class TabulatedSurface {
 public:
  /// For `node_count` seeds. The surface must outlive the table.
  TabulatedSurface(const RadialSurface& surface, int node_count, const Execution& execution);

  const RadialSurface& surface() const { return surface_; }
  int node_count() const { return node_count_; }
  int rows() const;                          ///< of the grid
  const std::vector<double>& radii() const;  ///< at the grid's nodes
  const GridField& area_elements() const;    ///< dA/dOmega at the grid's nodes
  /// Returns S, the surface's area: from the area elements if they were computed, else by
  /// quadrature; both within 1e-3.
  double area() const;
  /// Returns the radius of the sphere of the same area.
  double radius() const { return std::sqrt(area() / (4.0 * pi)); }

 private:
  const RadialSurface& surface_;
  int node_count_;
  Execution execution_;
  mutable std::vector<double> radii_;
  mutable std::optional<GridField> area_elements_;
};

// The rule by which a weighting gives weights to the seed model. Each weighting is one function.
// To add one, add a function and its entry in weights.cpp, and a value with its row in
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

/// The weightings for a given surface (see Weighting).
///
/// The quantity behind a weight is tabulated once, so a seed's weight costs a look-up, not a
/// series.
class SurfaceSeedModel : public SeedModel {
 public:
  /// For `node_count` >= 4 seeds. Throws Error(InvalidInput) for options out of range.
  SurfaceSeedModel(const RadialSurface& surface, const WeightingOptions& options, int node_count,
                   const Execution& execution);

  void weights(const std::vector<Vector3>& seeds, const Execution& execution,
               std::vector<double>& result) const override;

  /// Returns the wanted number of seeds per steradian, for the start; its integral over the sphere
  /// is N. At most 1 / smallest_cell_share of the mean.
  std::vector<double> number_densities(const std::vector<Vector3>& directions,
                                       const Execution& execution) const;

 private:
  /// Returns the wanted number of seeds per steradian at a value of the field.
  double number_density(double value) const;

  int node_count_;
  WeightingRule rule_;               ///< its field has become field_
  std::optional<SphereGrid> field_;  ///< empty if all weights are equal
  FieldDeviation wanted_;            ///< of the field over the wanted density
  double offset_ = 0.0;              ///< C in "cell area = 3.118 w + C"
};

/// Returns whether a sampling exists for any number of points.
bool takes_any_count(Sampling sampling);

/// Returns the points of a sampling that is not relaxed: `count` of them, or the nearest possible
/// number (see takes_any_count). Unit vectors. Throws Error(InvalidInput) for Sampling::Weighted.
std::vector<Vector3> unrelaxed_seeds(Sampling sampling, int count);

/// Returns `count` >= 4 unit vectors from which the relaxation starts: a Fibonacci lattice warped
/// to the density that `model` wants.
std::vector<Vector3> start_seeds(const SurfaceSeedModel& model, int count,
                                 const Execution& execution);

}  // namespace wscvt
