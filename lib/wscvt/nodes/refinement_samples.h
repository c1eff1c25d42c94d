// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/refinement_target.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

/// Places in an array of samples.
using SampleList = std::vector<std::int32_t>;

/// The samples in each triangle of nodes, by their directions; every sample stands in exactly one
/// list.
std::vector<SampleList> samples_of_triangles(const std::vector<RefinementNode>& nodes,
                                             const SphereTriangulation& triangulation,
                                             const RefinementSamples& samples,
                                             const Execution& execution);

}  // namespace wscvt
