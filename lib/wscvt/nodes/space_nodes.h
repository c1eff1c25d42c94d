// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/normal_least_squares.h"
#include "wscvt/nodes/placed_nodes.h"
#include "wscvt/surface/grain.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/relaxation.h"
#include "wscvt/tessellation/seeding.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

/// What became of nodes on a mapped surface.
struct SpaceNodesReport {
  std::size_t self_intersections = 0;  ///< pairs of triangles of the mesh that meet, exactly
  int repairs = 0;                     ///< relaxations with more nodes where triangles had met
  double volume_loss = 0.0;  ///< of the nodes on the surface, as a share of the grain's volume
  /// Above 0: the nodes asked for are too few for the shape (they lose more than a quarter of its
  /// volume, or their triangles meet), and so many would do; too_many_nodes where none of the
  /// numbers tried does.
  int enough_nodes = 0;
  NormalFitReport fit;  ///< of a least-squares placement
};

/// No number of nodes up to sixteen times that asked for would do.
inline constexpr int too_many_nodes = -1;

struct SpaceNodes {
  PlacedNodes placed;
  RelaxationReport relaxation;
  SpaceNodesReport report;
};

/// Tessellates a spherical grain in space and puts the nodes on the scan, or fits them to it along
/// their normals. FittedSurface is on the scan too, since there is no series.
///
/// Where triangles of the nodes on the surface meet, which sheets nearer to each other than the
/// chords are deep bring about, up to three more relaxations give the places concerned more nodes,
/// taken from everywhere else. A fit does not add to what is left.
///
/// Throws Error: InvalidInput for options out of range and a grain that is not Spherical,
/// NumericalFailure when the nodes enclose no volume, when the triangulation breaks down, or when
/// triangles meet and `placement.refuse_self_intersections` is set, each time with the number of
/// nodes that would do, Cancelled.
SpaceNodes place_in_space(const Grain& grain, int node_count, const SeedingOptions& seeding,
                          const WeightingOptions& weighting, const RelaxationOptions& relaxation,
                          const MultilevelOptions& levels, const PlacementOptions& placement,
                          double volume, const Execution& execution);

}  // namespace wscvt
