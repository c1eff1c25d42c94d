// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/execution.h"
#include "wscvt/mesh.h"
#include "wscvt/mesh_surface.h"
#include "wscvt/sphere_triangulation.h"

namespace wscvt {

struct RefinementOptions {
  int rounds = 0;                ///< at most so many, in [0, 1000]; 0: nothing is done
  double smallest_angle = 18.0;  ///< kept from below in every triangle, degrees, in [0, 40]
  double tolerance = 2e-3;       ///< stop when a round lowers the distance by less than this share
};

/// One line of the refinement's history.
struct RefinementStep {
  double distance = 0.0;  ///< rms distance from the samples to the mesh after the round; length
  int moves = 0;          ///< nodes moved
  int flips = 0;          ///< edges flipped
  int relocations = 0;    ///< nodes taken from where they help least to where they help most
};

struct RefinementReport {
  bool converged = false;       ///< the last round lowered the distance by less than the tolerance
  double start_distance = 0.0;  ///< rms distance before the first round; length
  std::vector<RefinementStep> history;
};

struct RefinedNodes {
  std::vector<Vector3> positions;     ///< about the origin
  SphereTriangulation triangulation;  ///< of their directions
  RefinementReport report;
};

RefinedNodes refine_nodes(std::vector<Vector3> positions, SphereTriangulation triangulation,
                          const MeshSurface& original, const RefinementOptions& options,
                          const Execution& execution);

}  // namespace wscvt
