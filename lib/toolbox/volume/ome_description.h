// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "toolbox/volume/tiff_dimensions.h"

namespace wscvt {

/// Returns the layout given in OME's XML, in any order of dimensions, as tiff_layout does:
/// https://docs.openmicroscopy.org/ome-model/latest/ome-tiff/specification.html
TiffLayout layout_of_ome(const std::string& text, std::int64_t pages, std::int64_t samples,
                         const std::string& path);

}  // namespace wscvt
