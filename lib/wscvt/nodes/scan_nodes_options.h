// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace wscvt {

/// Weighting: the wanted size of the cell of a node on the scan.
enum class CellWeighting {
  Area,           ///< WSCVT-D: equal areas of the surface
  Curvature,      ///< WSCVT-C: smaller cells where the surface bends
  ErrorAdaptive,  ///< cells that let flat triangles err alike everywhere
};

/// The least and the most mean edge ratio that may be asked for, and the default.
inline constexpr double least_edge_ratio = 1.08;
inline constexpr double most_edge_ratio = 1.7;
inline constexpr double default_edge_ratio = 1.105;

/// Options of the nodes on a scan.
struct ScanNodesOptions {
  CellWeighting weighting = CellWeighting::Area;
  double curvature_alpha = 1.0;  ///< alpha of WSCVT-C, -3 to 3
  /// The wanted mean ratio of a triangle's longest to its shortest edge, 1.08 to 1.7: even
  /// triangles at the low end, the closest surface at the high one.
  double edge_ratio = default_edge_ratio;
  bool fitted = true;  ///< false: nodes stay evened, on the scan, and `edge_ratio` is not read
};

/// Report of the placement of nodes.
struct ScanNodesReport {
  std::size_t scan_vertices = 0;
  std::size_t split_vertices = 0;  ///< put on long edges of a scan too coarse for its nodes
  std::size_t proxy_vertices = 0;  ///< of the coarsened scan that the nodes were evened on
  std::size_t genus = 0;           ///< handles of the scan, and of the result
  int evening_steps = 0;
  int evening_flips = 0;
  int fit_rounds = 0;
  int fit_flips = 0;
  int relocations = 0;
  int polished = 0;
  double mean_edge_ratio = 0.0;             ///< reached
  double volume_offset = 0.0;               ///< the last, along the normals; equivalent radii
  std::size_t mended_intersections = 0;     ///< pairs of triangles that met and were parted
  std::size_t self_intersections = 0;       ///< pairs left
  std::size_t scan_self_intersections = 0;  ///< pairs of the scan, counted where any are left
  /// Where pairs are left and the scan has none: more nodes that were tried and leave none, up to
  /// three times as many; 0 if none of those tried did.
  int enough_nodes = 0;
};

}  // namespace wscvt
