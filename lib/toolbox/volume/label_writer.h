// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Throws Error(InvalidInput) for a name that write_labels cannot write.
void check_label_file(const std::string& path);

/// Writes labels up to `largest`, larger ones as 0, by the ending of the name, .nrrd or .mha.
/// Labels are packed, with 16 bits or, if these are not enough, 32. The file has the size of
/// voxels, their directions, the position of the first, and the unit, so reading it gives the same
/// volume. Written completely or not at all; memory is the packed labels. Throws Error:
/// InvalidInput for another ending, Cancelled, MachineRefused as write_file does, and what the
/// volume throws.
void write_labels(const std::string& path, LabelVolume& volume, Label largest,
                  const Execution& execution);

}  // namespace wscvt
