// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Pairs of triangles of a mesh that intersect, counted in bounded time.
struct CrossingPairs {
  std::size_t count = 0;  ///< of triangles with an area
  /// Whether all triangles were looked at. Else 500, spread over the mesh, were looked at, each
  /// against all others.
  bool is_all = true;
};

/// Counts the pairs of triangles that intersect outside their shared corners and edges. A mesh of
/// up to 500 triangles is looked at as a whole, one of more than 2,000,000 not at all. Throws
/// Error(Cancelled).
CrossingPairs crossing_pairs(const IndexedMesh& mesh, const Execution& execution = Execution(1));

/// Returns a sentence on the pairs of `whose` mesh, such as "the scan"; empty without pairs.
std::string crossing_sentence(const CrossingPairs& pairs, const std::string& whose);

}  // namespace wscvt
