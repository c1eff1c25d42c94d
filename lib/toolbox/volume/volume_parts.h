// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Returns the voxels with each part numbered from 1, in the order in which parts begin. A part is
/// the voxels of one label that are connected by faces. The background becomes 0. Reads the volume
/// once. Memory is four bytes per stretch that begins a part, and the stretches of two slices.
/// Throws Error: InvalidInput for more than 100 million such stretches, as in noise, Cancelled, and
/// what the volume throws.
std::unique_ptr<LabelVolume> parts_of(std::unique_ptr<LabelVolume> volume, Label background,
                                      const Execution& execution);

}  // namespace wscvt
