// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/nodes/placed_nodes.h"
#include "wscvt/surface/grain.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/relaxation.h"
#include "wscvt/tessellation/seeding.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

struct SpaceNodes {
  PlacedNodes placed;
  RelaxationReport relaxation;
  SpaceNodesReport report;
};

/// What the tessellation in space follows.
struct SpaceTessellationOptions {
  SeedingOptions seeding;
  WeightingOptions weighting;
  RelaxationOptions relaxation;  ///< in space whatever its metric
  MultilevelOptions levels;
};

/// Tessellates a spherical grain in space and puts the nodes on the scan, or fits them to it along
/// their normals. Series is on the scan too, since there is none. `to_scan` measures the distance
/// to `grain.mesh`; it is asked only where a level of the scan is what is mapped, and may be null
/// elsewhere. `volume` is the scan's.
///
/// Where triangles of the nodes on the surface meet, which sheets nearer to each other than the
/// chords are deep bring about, the relaxation is made again from seeds spread by area, and the
/// better of both is taken. Where triangles meet still, up to five more relaxations give the places
/// concerned more nodes, taken from everywhere else, and mending takes nodes out. Where that leaves
/// triangles that meet or small angles, all of it is done again on up to two maps that keep angles
/// better (SphereMapOptions::angle_weight), and the best is taken; a map that cannot be made is
/// passed over. A fit does not add to what is left.
///
/// Throws Error: InvalidInput for options out of range, a grain that is not Spherical and a level
/// without `to_scan`, NumericalFailure when the nodes enclose no volume, when the triangulation
/// breaks down, or when triangles meet and `placement.refuse_self_intersections` is set, each time
/// with the number of nodes that would do, Cancelled.
SpaceNodes place_in_space(const Grain& grain, const MeshDistance* to_scan, int node_count,
                          const SpaceTessellationOptions& options,
                          const PlacementOptions& placement, double volume,
                          const Execution& execution);

}  // namespace wscvt
