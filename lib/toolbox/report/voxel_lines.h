// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/sample/grain_table.h"

namespace wscvt {

/// Returns sentences for a log about the voxels of a sample, from its table of shapes with the
/// columns of the resolution: how many voxels across the grains are, what the voxels did to the
/// main descriptors, and whether there are more nodes than the voxels resolve. Empty if the size of
/// no grain's voxels is known.
std::vector<std::string> voxel_lines(const GrainTable& shapes);

}  // namespace wscvt
