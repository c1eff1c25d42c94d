// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Returns the standard deviation of the blur of a scan, that of its voxels included, from its grey
/// values along lines from the inside of a label to the void; length. `scan` gives grey values from
/// then on. Reads both volumes once.
///
/// A profile v, 1 in the grain and 0 in the void, is an error function, stretched by 1 / |n| along
/// a line that is inclined to the normal: the integral of v (1 - v) is s / (sqrt(pi) |n|). Among
/// the lines that cross a surface of all directions, half have |n| above sqrt(1/2). The median over
/// the lines along the first two axes therefore gives s.
///
/// Throws Error: InvalidInput if the volumes have different counts of voxels, if less than 100
/// lines cross an edge with six voxels of a label and six of void on its sides, or if both sides
/// have the same grey values; Cancelled, and what the volumes throw.
double edge_width(LabelVolume& labels, Label background, LabelVolume& scan,
                  const Execution& execution);

}  // namespace wscvt
