// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/radial_surface.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// Weights of seeds at any position, for the relaxation. One value per seed, in their order.
class SeedModel {
 public:
  virtual ~SeedModel() = default;

  /// Computes power weights in steradian for the seeds; empty if all are equal.
  virtual void weights(const std::vector<Vector3>& seeds, const Execution& execution,
                       std::vector<double>& result) const = 0;
};

// The rule by which a weighting gives weights to the seed model. Each weighting is one function.
// To add one, add a function and its case in weights.cpp, and a value with its row in
// tessellation_options.h.

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
