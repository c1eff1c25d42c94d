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
  Contact,       ///< off it, so that contacts by the deepest node are where the scan's own would be
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
      {NodePlacement::Contact, "contact", "contact of the deepest node",
       "off the surface, so that contacts which the deepest node decides come neither late nor "
       "early in the mean; the volume is not the scan's"},
  };
};

/// How the nodes are placed.
struct PlacementOptions {
  NodePlacement kind = NodePlacement::LeastSquares;
  RefinementOptions refinement;  ///< of the nodes towards the scan, on any map; needs is_fitted
  /// Of the balls that nodes placed by Contact are fitted to touch, equivalent radii, in (0, 100];
  /// see fit_to_contacts. At these the mean error of a first contact is least, measured in
  /// tests/study: 0.4 for nodes against the surface of another grain, 1.3 where the nodes of both
  /// are looked at and the deepest decides, 5 for flat walls.
  double contact_radius = 0.4;
  /// Refuse a result in which triangles meet, which a radial one never has.
  bool refuse_self_intersections = false;
};

inline constexpr NumberOption<double> contact_radius_option = {
    "contact-radius",
    "radius of the balls that contact nodes are fitted to",
    0.0,
    100.0,
    Ends::NotMinimum,
    "in equivalent radii; 0.4 for nodes against another grain's surface, 1.3 where the nodes of "
    "both "
    "grains are looked at, 5 for flat walls"};
inline constexpr FlagOption refuse_self_intersections_option = {
    "refuse-self-intersections", "refusal of self-intersections",
    "(triangles that meet) in a remesh, instead of a warning"};

/// Whether nodes leave the surface to fit it.
inline bool is_fitted(NodePlacement placement) {
  return placement == NodePlacement::LeastSquares || placement == NodePlacement::Contact;
}

/// Throws Error(InvalidInput) for options out of range, and for a refinement of nodes that are to
/// stay on a surface.
void check_placement_options(const PlacementOptions& options);

}  // namespace wscvt
