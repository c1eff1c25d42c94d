// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toolbox/convex/convex_options.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"

namespace wscvt {

/// Closed convex meshes whose union represents a grain.
using ConvexParts = std::vector<IndexedMesh>;

/// Makes at most K convex parts of a grain.
///
/// First, planes cut the mesh into 2 K pieces. Each cut divides the piece with the most expensive
/// hull (see HullCost), by the plane whose two sides have the cheapest hulls (see best_cuts).
/// Pieces are then joined in pairs, first the pair whose common hull adds the least cost. Then the
/// planes are moved and turned as long as the cost decreases. Finally the planes cut the scan, and
/// each part is the hull of its pieces of the scan, so the parts contain the whole scan. With K = 1
/// the part is the hull of the scan. If `faces` limits a hull, the part is the hull of some of its
/// points, and the other points lie outside (see measure_parts).
///
/// `mesh` is closed, outward and free of self-intersections, with some thousand vertices at most,
/// such as a remesh of the scan. `scan` is closed and outward; if it is empty, the parts are made
/// of `mesh`. Deterministic; the result does not depend on the number of threads. Throws
/// Error(InvalidInput) for options out of range, a mesh without volume and a mesh that is not
/// closed; Error(Cancelled).
ConvexParts convex_parts(const IndexedMesh& mesh, const IndexedMesh& scan,
                         const ConvexOptions& options, const Execution& execution = Execution());

/// Returns the convex parts in a mesh, such as a file of parts: the hulls of its connected
/// components, in the order of their first triangles. Leaves out components without volume.
ConvexParts parts_of(const IndexedMesh& mesh);

/// Returns about 20,000 points on the surface of the parts, evenly distributed by area, without
/// points inside or on another part.
std::vector<Vector3> outer_points(const ConvexParts& parts);

/// Errors of parts against a grain. Lengths and volumes in the unit of the mesh.
struct PartsMeasures {
  double largest_distance = 0.0;  ///< from the surface of the parts to the grain's
  double rms_distance = 0.0;      ///< from the parts' surface, over its area, to the grain's
  double largest_gap = 0.0;       ///< from points of the grain outside of all parts to the parts
  double parts_volume = 0.0;      ///< of the union of all parts
  double shared_volume = 0.0;     ///< sum of the parts' volumes, less the union's
  double grain_volume = 0.0;

  /// Volume of the parts / the grain's, less 1, in %.
  double excess_percent() const {
    return without_rounding(100.0 * (parts_volume / grain_volume - 1.0), 1.0);
  }
};

/// Measures parts against a closed outward mesh: distances at outer_points, shared volumes on a
/// grid of 96 cells along the longest side. Throws Error(InvalidInput) if there is no part or the
/// mesh has no volume, Error(Cancelled).
PartsMeasures measure_parts(const ConvexParts& parts, const IndexedMesh& grain,
                            const Execution& execution = Execution());

/// Returns the parts as one mesh, in their order.
IndexedMesh joined(const ConvexParts& parts);

}  // namespace wscvt
