// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "wscvt/base/option.h"
#include "wscvt/nodes/refinement_options.h"

namespace wscvt {

/// Where the nodes are put along their directions.
enum class NodePlacement {
  Series,        ///< on the fitted series
  Scan,          ///< on the scan itself, by rays
  LeastSquares,  ///< off it, so that the triangles fit the scan best and the volume is the scan's
};

template <>
struct EnumerationTable<NodePlacement> {
  static constexpr std::string_view key = "placement";
  static constexpr std::string_view subject = "placement of the nodes";
  static constexpr Enumerator<NodePlacement> rows[] = {
      {NodePlacement::Series, "series", "series",
       "on the fitted surface, which is free of scanning noise"},
      {NodePlacement::Scan, "scan", "scan",
       "on the scan itself, with its noise, where rays from the centroid leave it"},
      {NodePlacement::LeastSquares, "least-squares", "least squares (volume exact)",
       "off the surface, so that the triangles fit the scan best and enclose exactly its volume"},
  };
};

struct PlacementOptions {
  NodePlacement kind = NodePlacement::LeastSquares;
  RefinementOptions refinement;  ///< of the nodes towards the scan; needs LeastSquares, and Radial
  /// Refuse a result in which triangles meet, which a radial one never has.
  bool refuse_self_intersections = false;
};

inline constexpr FlagOption refuse_self_intersections_option = {
    "refuse-self-intersections", "refusal of self-intersections",
    "refuse a remesh in which triangles meet, instead of warning"};

/// Throws Error(InvalidInput) for options out of range, and for a refinement of nodes that are to
/// stay on a surface.
void check_placement_options(const PlacementOptions& options);

}  // namespace wscvt
