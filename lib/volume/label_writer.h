// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Throws Error(InvalidInput) for a name that write_labels does not know.
void check_label_file(const std::string& path);

/// Writes labels up to `largest`, those above it as 0, by the ending of the name, .nrrd or .mha,
/// packed, as numbers of 16 bits or, where that is too small, 32; with the size of voxels, their
/// directions, the place of the first, and the unit. Read again they are the same volume. Whole or
/// not at all; memory is that of the packed labels. Throws Error: InvalidInput for another ending,
/// Cancelled, MachineRefused as write_file does, and what the volume throws.
void write_labels(const std::string& path, LabelVolume& volume, Label largest,
                  const Execution& execution);

}  // namespace wscvt
