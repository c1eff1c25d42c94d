// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Returns 1 for each voxel that was not scanned, x fastest; empty if all were. Reads the volume,
/// which gives grey values, once or twice. Not scanned are, as far as they are connected to the
/// border by faces:
/// - voxels that are not a number;
/// - voxels of one value that fills most corners of the slices, if what they leave is a convex body
///   that reaches from one side of the volume to the opposite one, such as the cylinder of a
///   reconstruction. Void between grains leaves no convex body.
std::vector<std::uint8_t> not_scanned(LabelVolume& scan, const Execution& execution);

}  // namespace wscvt
