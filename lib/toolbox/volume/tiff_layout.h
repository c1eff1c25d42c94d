// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "toolbox/volume/tiff_dimensions.h"

namespace wscvt {

/// Reads what the text of one of many slices says of all: ImageJ's unit, distance of slices and
/// calibration. Of another text nothing: the slice is no stack.
TiffLayout slice_layout(const std::string& description);

/// Reads the layout of a file `path` with `pages` pages from its first page's text. Throws
/// Error(InputOutput), naming the file, if the text contradicts the pages, or has unknown
/// dimensions or files.
TiffLayout tiff_layout(const std::string& text, std::int64_t pages, const TiffPageShape& page,
                       const std::string& path);

}  // namespace wscvt
