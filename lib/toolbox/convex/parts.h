// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/convex/convex_options.h"
#include "toolbox/convex/convex_parts.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

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
