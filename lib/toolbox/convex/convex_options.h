// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/option.h"

namespace wscvt {

/// Options of the division of a grain into convex parts.
struct ConvexOptions {
  int parts = 8;           ///< max. number
  int faces = 255;         ///< max. number per part's hull; PhysX allows no more
  double tolerance = 0.5;  ///< max. distance of a hull that is not cut, % of the equivalent radius
};

/// Default number of nodes of the remesh on which the cuts are chosen. Fewer nodes take less time.
inline constexpr int convex_node_count = 500;

inline constexpr NumberOption<int> convex_parts_option = {
    "count", "number of parts", 1, 1000, Ends::Both, "at most this many convex parts"};
inline constexpr NumberOption<int> convex_faces_option = {
    "faces", "number of faces", 4, 100000, Ends::Both, "at most this many triangles per part"};
inline constexpr NumberOption<double> convex_tolerance_option = {
    "max-error",
    "allowed error",
    0.01,
    50.0,
    Ends::Both,
    "fewer parts if no hull is farther than this from the grain, in % of the equivalent radius"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_options(const ConvexOptions& options);

}  // namespace wscvt
