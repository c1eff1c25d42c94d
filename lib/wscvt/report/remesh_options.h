// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/measures/distances.h"
#include "wscvt/nodes/node_count_search.h"
#include "wscvt/nodes/placed_nodes.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/surface/grain.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/relaxation.h"
#include "wscvt/tessellation/seeding.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

/// Largest node count accepted.
inline constexpr int maximum_node_count = 1000000;

/// What is measured beyond descriptors and quality.
struct MeasureOptions {
  bool distances = false;  ///< fill RemeshResult::distances and vertex_distances
  DistanceOptions distance_sampling;
  bool node_curvatures = false;  ///< fill RemeshResult::curvatures
};

/// Everything a caller may choose, stage by stage; the defaults work.
struct RemeshOptions {
  int node_count = 1000;  ///< N, in [4, maximum_node_count]; with an error target the first N tried
  ErrorTarget target;
  MeshCheckOptions check;
  SurfaceOptions surface;
  SeedingOptions seeding;
  WeightingOptions weighting;
  RelaxationOptions relaxation;
  MultilevelOptions levels;
  PlacementOptions placement;
  MeasureOptions measures;
};

/// Throws Error(InvalidInput), with the range, for options out of range or at odds with each other.
void check_options(const RemeshOptions& options);

}  // namespace wscvt
