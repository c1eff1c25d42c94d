// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/surface/sphere_surface.h"
#include "wscvt/tessellation/seed_model.h"
#include "wscvt/tessellation/tessellation_options.h"
#include "wscvt/tessellation/weighting_rule.h"

namespace wscvt {

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

}  // namespace wscvt
