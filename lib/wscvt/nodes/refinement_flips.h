// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/refinement_facet.h"
#include "wscvt/nodes/refinement_state.h"

namespace wscvt {

/// An edge a b, the corners c to its left and d to its right, and what a flip would make of them.
struct FlipFacets {
  RefinementFacet left;    ///< a b c, of the half-edge
  RefinementFacet right;   ///< b a d, of its opposite
  RefinementFacet origin;  ///< c a d, which a flip puts in the half-edge's slot
  RefinementFacet end;     ///< d b c, which it puts in its opposite's
  Vector3 divide =
      Vector3::Zero();  ///< normal of the plane through c, d and the origin, towards a; length^2

  /// Of the smallest angle in the two triangles as they are.
  double largest_cosine() const { return std::max(left.largest_cosine, right.largest_cosine); }
  /// Whether both new triangles may be made.
  bool acceptable(double cosine_limit) const {
    return origin.acceptable(cosine_limit) && end.acceptable(cosine_limit);
  }
};

FlipFacets flip_facets(const RefinementState& state, std::int32_t half_edge);

/// Replaces an edge by the other diagonal of its two triangles and deals out their samples anew.
/// The new triangles must be acceptable (see FlipFacets).
void flip_edge(RefinementState& state, std::int32_t half_edge);

/// Flips edges, the most rewarding first, and returns how many.
int flip_edges(RefinementState& state, const Execution& execution);

}  // namespace wscvt
