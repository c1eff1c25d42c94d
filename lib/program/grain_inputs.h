// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "toolbox/job/grain_source.h"
#include "toolbox/volume/label_grains.h"

namespace wscvt::program {

/// Returns the files of the inputs of a batch, see grain_files. Throws wscvt::Error for a file that
/// is no volume and whose ending is that of no mesh.
std::vector<std::string> input_files(const std::vector<std::string>& inputs);

/// Opens the inputs of a batch: mesh files, and volumes of labels, whose labels it finds. With
/// options.parts, the bodies of a mesh are grains. Shows a line on a terminal and prints how the
/// inputs were read, unless quiet. Throws as LabelGrains. A mesh that cannot be read fails later,
/// in its row.
std::unique_ptr<GrainSource> open_inputs(const std::vector<std::string>& files,
                                         const VolumeOptions& options, const Shard& shard,
                                         bool quiet);

}  // namespace wscvt::program
