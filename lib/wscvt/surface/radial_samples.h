// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The vertices of a closed mesh about the origin that are seen in their direction: where
/// scan_curvatures reads the scan.
struct RadialSamples {
  std::vector<Vector3> directions;     ///< unit vectors
  std::vector<double> weights;         ///< steradian, > 0: a third of each outward face around
  std::vector<std::int32_t> vertices;  ///< index of each sample's vertex, ascending
};

/// One sample a vertex. Where the mesh folds, a vertex behind the outermost sheet is left out; rays
/// are cast there only. A mesh that does not hold the origin inside (folded_solid_angle >= 1) gives
/// no samples. Throws Error(InvalidInput) when the mesh is empty.
RadialSamples radial_samples(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
