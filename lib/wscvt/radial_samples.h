// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/execution.h"
#include "wscvt/mesh.h"

namespace wscvt {

/// The vertices of a closed mesh about the origin as samples of its radius.
struct RadialSamples {
  std::vector<Vector3> directions;     ///< unit vectors
  std::vector<double> radii;           ///< length, > 0
  std::vector<double> weights;         ///< solid angle each stands for, steradian, > 0
  std::vector<std::int32_t> vertices;  ///< index of each sample's vertex
};

RadialSamples radial_samples(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
