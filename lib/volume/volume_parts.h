// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// The same voxels, those of each part numbered from 1 in the order in which parts begin: a part is
/// what hangs together by faces of voxels of one label. The background becomes 0. The volume is
/// read once here, and memory is four bytes a stretch that begins a part, besides two slices of
/// stretches. Throws Error: InvalidInput for more than 100 million such stretches, which noise has,
/// Cancelled, and what the volume throws.
std::unique_ptr<LabelVolume> parts_of(std::unique_ptr<LabelVolume> volume, Label background,
                                      const Execution& execution);

}  // namespace wscvt
