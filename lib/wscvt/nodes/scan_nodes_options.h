// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace wscvt {

/// Weighting: the wanted size of the cell of a node on the scan.
enum class CellWeighting {
  Area,       ///< WSCVT-D: equal areas of the surface
  Curvature,  ///< WSCVT-C: smaller cells where the surface bends
};

/// Range and default of the wanted mean edge ratio.
inline constexpr double least_edge_ratio = 1.08;
inline constexpr double most_edge_ratio = 1.6;
inline constexpr double default_edge_ratio = 1.1;

/// Options of the nodes on a scan.
struct ScanNodesOptions {
  CellWeighting weighting = CellWeighting::Area;
  double curvature_alpha = 1.0;  ///< alpha of WSCVT-C, -3 to 3
  /// Wanted mean of longest / shortest edge of a triangle, 1.08 to 1.6. Small values give even
  /// triangles, large values a mesh closer to the scan.
  double edge_ratio = default_edge_ratio;
  bool fitted = true;  ///< false: nodes stay on the scan after edge-length equalization, and
                       ///< `edge_ratio` is not used
};

/// Report of the placement of nodes.
struct ScanNodesReport {
  std::size_t scan_vertices = 0;
  std::size_t split_vertices = 0;  ///< added on long edges of a scan too coarse for its nodes
  std::size_t proxy_vertices = 0;  ///< of the coarsened scan used for edge-length equalization
  std::size_t genus = 0;           ///< number of handles of the scan and of the result
  int equalization_steps = 0;
  int equalization_flips = 0;
  int fit_rounds = 0;
  int fit_flips = 0;
  int relocations = 0;
  int polished = 0;
  double mean_edge_ratio = 0.0;             ///< reached
  double volume_offset = 0.0;               ///< last offset along the normals; equivalent radii
  std::size_t repaired_intersections = 0;   ///< intersecting triangle pairs that were separated
  std::size_t self_intersections = 0;       ///< pairs left
  std::size_t scan_self_intersections = 0;  ///< pairs of the scan, counted if any are left
};

}  // namespace wscvt
