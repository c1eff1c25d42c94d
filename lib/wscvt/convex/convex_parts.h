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
/// Planes cut the mesh into twice as many pieces as parts, each time the piece whose hull costs
/// most (see HullCost), by the plane whose two sides have the cheapest hulls (see best_cuts).
/// Pieces are then joined two by two, those first whose common hull adds least. Then the planes are
/// moved and turned as long as the cost decreases. At last the planes cut the scan, and each part
/// is the hull of its pieces of the scan: the parts hold the whole scan. With K = 1 the part is the
/// hull of the scan. If `faces` is less than a hull has, the part is the hull of some of its
/// points, and others stick out (see measure_parts).
///
/// `mesh` is closed, outward and free of self-intersections, of some thousand vertices at most,
/// such as a remesh of the scan. `scan` is closed and outward; if it is empty, the parts are those
/// of `mesh`. Deterministic, and the same on any number of threads. Throws Error(InvalidInput) for
/// options out of range, a mesh without volume and a mesh that is not closed; Error(Cancelled).
ConvexParts convex_parts(const IndexedMesh& mesh, const IndexedMesh& scan,
                         const ConvexOptions& options, const Execution& execution = Execution());

/// The convex parts that a mesh holds, such as a file of them: the hulls of its connected
/// components, in the order of their first triangles. Components without volume are left out.
ConvexParts parts_of(const IndexedMesh& mesh);

/// About 20,000 points of the surface of the parts, spread evenly by area, without those that lie
/// in another part or on its surface.
std::vector<Vector3> outer_points(const ConvexParts& parts);

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

/// Measures parts against a closed outward mesh. Distances are taken at outer_points, shared
/// volumes on a grid of 96 cells along the longest side. Throws Error(InvalidInput) if there is no
/// part or the mesh has no volume, Error(Cancelled).
PartsMeasures measure_parts(const ConvexParts& parts, const IndexedMesh& grain,
                            const Execution& execution = Execution());

/// The parts as one mesh, one after the other.
IndexedMesh joined(const ConvexParts& parts);

}  // namespace wscvt
