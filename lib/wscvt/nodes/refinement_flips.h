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
  /// Normal of the plane through the directions of c and d and the sphere's centre, towards a.
  Vector3 divide = Vector3::Zero();

  /// Of the smallest angle in the two triangles as they are.
  double largest_cosine() const { return std::max(left.largest_cosine, right.largest_cosine); }
  /// Whether both new triangles may be made.
  bool acceptable(double cosine_limit) const {
    return origin.acceptable(cosine_limit) && end.acceptable(cosine_limit);
  }
};

FlipFacets flip_facets(const RefinementState& state, std::int32_t half_edge);

/// Whether the edges about the two triangles may turn as they would after the flip, see may_turn.
bool flip_may_turn(const RefinementState& state, std::int32_t half_edge, const FlipFacets& flip);

/// Replaces an edge by the other diagonal of its two triangles and deals out their samples anew.
/// The new triangles must be acceptable (see FlipFacets).
void flip_edge(RefinementState& state, std::int32_t half_edge);

/// Flips edges, the most rewarding first, and returns how many.
int flip_edges(RefinementState& state, const Execution& execution);

}  // namespace wscvt
