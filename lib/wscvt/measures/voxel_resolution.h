// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace wscvt {

/// One descriptor of a voxelised grain, with what its voxels did to it.
struct ResolvedValue {
  std::string key;         ///< as in list_descriptors
  double value = 0.0;      ///< of the grain as it is
  double again = 0.0;      ///< of the second surface, see measure_resolution; a mean of its poses
  double scatter = 0.0;    ///< of the second surface, see measure_resolution
  double corrected = 0.0;  ///< without the bias of the voxels; NaN if not resolved
  double low = 0.0;        ///< ends of the interval of 95 %; NaN if not resolved
  double high = 0.0;

  bool is_resolved() const { return std::isfinite(corrected); }
};

/// What the voxels did to a grain's descriptors; the toolbox's measure_resolution fills it.
struct Resolution {
  double voxel_size = 0.0;          ///< length
  double voxels_across = 0.0;       ///< equivalent diameter over the size of a voxel
  bool has_voxels = true;           ///< the mesh shows its voxels; else nothing is resolved
  std::vector<ResolvedValue> rows;  ///< one for each of list_descriptors
};

/// Returns the number of nodes from which on a remesh shows the voxels' noise and no more of the
/// grain: a node then has a cell of 2 by 2 voxels. Measured by tests/figures/study/voxel_study.py.
/// `area` of the scan, length^2; `voxel_size` > 0, length.
inline double resolved_nodes(double area, double voxel_size) {
  constexpr double side = 2.0;
  return area / (side * voxel_size * side * voxel_size);
}

/// Voxels across a grain below which no trend of any descriptor can be trusted.
inline constexpr double least_trusted_across = 15.0;

}  // namespace wscvt
