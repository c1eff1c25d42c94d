// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// Options of the division of a grain into convex parts.
struct ConvexOptions {
  int parts = 8;           ///< max. number
  int faces = 255;         ///< max. number per part's hull; PhysX allows no more
  double tolerance = 0.5;  ///< max. distance of a hull that is not cut, % of the equivalent radius
};

/// Default number of nodes of the remesh on which the cuts are chosen. Fewer nodes take less time.
inline constexpr int convex_node_count = 500;
inline constexpr NumberOption<int> convex_nodes_option = {
    "nodes",
    "number of nodes",
    node_count_option.minimum,
    node_count_option.maximum,
    Ends::Both,
    "of the remesh on which the cuts are chosen"};

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

/// Closed convex meshes whose union represents a grain.
using ConvexParts = std::vector<IndexedMesh>;

/// Makes at most K convex parts of a grain.
///
/// First, planes cut the mesh into 2 K pieces. Each cut divides the piece with the most expensive
/// hull (see HullCost), by the plane whose two sides have the cheapest hulls (see best_cuts).
/// Pieces are then joined in pairs, first the pair whose common hull adds the least cost. Then the
/// planes are moved and turned as long as the cost decreases. Finally the planes cut the scan, and
/// each part is the hull of its pieces of the scan, so the parts contain the whole scan. make_parts
/// then scales them to the grain's volume, so that the scan reaches out of them. With K = 1 the
/// part is the hull of the scan. If `faces` limits a hull, the part is the hull of some of its
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

/// Convex parts and their grain, in the scan's units and coordinates.
struct PartsResult {
  ConvexParts parts;
  PartsMeasures measures;
  ShapeDescriptors scan;           ///< of the grain: the mass properties that the parts should have
  IndexedMesh grain;               ///< the repaired scan: closed, outward
  std::vector<Sentence> warnings;  ///< sentences for the user
};

/// Makes convex parts of a scan, which is repaired as in remesh(). convex_parts chooses the cuts on
/// a remesh with `remesh_options`, for which convex_node_count nodes are enough, and makes the
/// parts of the scan. Then all parts are scaled together about the grain's centroid, so that their
/// union has the grain's volume: a packing has the right porosity, and parts begin on both sides of
/// the grain's surface instead of outside of it. measure_parts measures their errors. The result
/// does not depend on the number of threads. Throws Error as remesh and convex_parts do.
PartsResult make_parts(IndexedMesh scan, RemeshOptions remesh_options, const ConvexOptions& options,
                       const Execution& execution = Execution());

}  // namespace wscvt
