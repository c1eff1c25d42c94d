// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/convex/convex_options.h"

namespace wscvt {

/// Closed convex meshes whose union stands for a grain.
using ConvexParts = std::vector<IndexedMesh>;

/// Takes a grain apart into at most K convex parts.
///
/// The grain is cut by planes into more pieces than parts, each time the piece whose hull is
/// farthest from the grain, by the plane whose two sides have hulls nearest to it (see best_cuts).
/// Then pieces are joined two by two, those first whose common hull costs least. Each part is the
/// hull of its pieces, and holds the points of `scan` nearest to it: with K = 1 it is the hull of
/// the scan. With fewer faces than the hull has, a part is the hull of some of its points, and
/// others stick out (see measure_parts).
///
/// `mesh` is closed, outward and free of self-intersections, of some thousand vertices at most,
/// such as a remesh of the scan. `scan` may be empty. Deterministic, and the same on any number of
/// threads. Throws Error(InvalidInput) for options out of range and a mesh without volume,
/// Error(Cancelled).
ConvexParts convex_parts(const IndexedMesh& mesh, const std::vector<Vector3>& scan,
                         const ConvexOptions& options, const Execution& execution = Execution());

/// The convex parts that a mesh holds, such as a file of them: the hulls of its connected
/// components, in the order of their first triangles. Components without volume are left out.
ConvexParts parts_of(const IndexedMesh& mesh);

/// How well parts stand for a grain. Lengths and volumes in the unit of the mesh.
struct PartsMeasures {
  double largest_distance = 0.0;  ///< from the surface of the parts to the grain's
  double rms_distance = 0.0;      ///< the same, over the area of the parts' surface
  double largest_gap = 0.0;       ///< from points of the grain outside of all parts to the parts
  double parts_volume = 0.0;      ///< of all parts together; what parts share counts once
  double shared_volume = 0.0;     ///< what would count more than once
  double grain_volume = 0.0;

  /// Volume of the parts / the grain's, less 1, in %.
  double excess_percent() const { return 100.0 * (parts_volume / grain_volume - 1.0); }
};

/// Measures parts against a closed outward mesh. Distances are taken at 20,000 points of the parts'
/// surface and at their vertices, shared volumes on a grid of 96 cells along the longest side.
/// Throws Error(InvalidInput) if there is no part or the mesh has no volume, Error(Cancelled).
PartsMeasures measure_parts(const ConvexParts& parts, const IndexedMesh& grain,
                            const Execution& execution = Execution());

/// The parts as one mesh, one after the other.
IndexedMesh joined(const ConvexParts& parts);

}  // namespace wscvt
