// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/option.h"

namespace wscvt {

/// How a grain is taken apart into convex parts.
struct ConvexOptions {
  int parts = 8;    ///< at most
  int faces = 255;  ///< of a part's hull, at most; PhysX takes no more
  double tolerance =
      0.5;  ///< largest distance of hulls that need no cut, % of the equivalent radius
};

/// Nodes of the remesh on which the cuts are chosen, unless told otherwise. Fewer nodes take less
/// time.
inline constexpr int convex_node_count = 500;

inline constexpr NumberOption<int> convex_parts_option = {
    "parts", "number of parts", 1, 1000, Ends::Both, "largest number of convex parts"};
inline constexpr NumberOption<int> convex_faces_option = {
    "faces", "number of faces", 4, 100000, Ends::Both, "largest number of triangles of a part"};
inline constexpr NumberOption<double> convex_tolerance_option = {
    "hull-distance",
    "distance that needs no cut",
    0.01,
    50.0,
    Ends::Both,
    "fewer parts where no hull is farther than this from the grain, % of the equivalent radius"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_options(const ConvexOptions& options);

}  // namespace wscvt
