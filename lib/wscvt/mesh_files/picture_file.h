// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Reads a picture: PNG, JPEG, BMP or TGA. Grey values become colours; transparency is ignored.
/// Throws Error(InputOutput) for a file that cannot be read or has more than 400 million pixels,
/// and if wscvt was built without stb_image.
TexturePicture read_picture(const std::string& path);

}  // namespace wscvt
