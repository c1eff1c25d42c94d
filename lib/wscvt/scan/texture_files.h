// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Reads the pictures of these names from the folder of the mesh, `mesh_path`. With libraries,
/// files of materials (.mtl), the names are those of materials. A material without a picture
/// becomes one pixel of its colour, if another one has a picture. A name that comes from another
/// machine is looked for without its folders too. Adds a warning for each file that is missing or
/// cannot be read. Throws Error(Cancelled).
std::vector<TexturePicture> pictures_of(const std::vector<std::string>& names,
                                        const std::vector<std::string>& libraries,
                                        const std::string& mesh_path,
                                        std::vector<std::string>& warnings,
                                        const Execution& execution);

}  // namespace wscvt
