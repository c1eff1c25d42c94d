// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Reads the pictures with these names from the folder of the mesh, `mesh_path`. With `libraries`,
/// files of materials (.mtl), the names are names of materials. A material without a picture
/// becomes one pixel of its colour, if another material has a picture. Also looks for a name
/// without its folders, because it may come from another machine. Adds a warning for each file that
/// is missing or cannot be read. Throws Error(Cancelled).
std::vector<TexturePicture> pictures_of(const std::vector<std::string>& names,
                                        const std::vector<std::string>& libraries,
                                        const std::string& mesh_path,
                                        std::vector<std::string>& warnings,
                                        const Execution& execution);

}  // namespace wscvt
