// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "marching_cubes.h"

namespace wscvt::test {

/// Gaussian of the given standard deviation, in nodes, along every axis; the border is continued.
void blur(VoxelGrid& grid, double deviation);

}  // namespace wscvt::test
