// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/tiff_layout.h"
#include "toolbox/volume/tiff_pages.h"
#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the size of a voxel along x and y from the resolution of a page, in centimetres if the
/// page has a unit; nothing without a resolution.
std::optional<Vector3> voxel_of_resolution(const TiffFile& file);

/// Sets the lattice from the text of ImageJ or OME, or from the page's resolution. Adds to the
/// layout's notes. Throws Error(InputOutput), naming the file, for axes in several units.
void set_lattice_of_tiff(VolumeGeometry& geometry, const TiffFile& file, const TiffPage& page,
                         TiffLayout& layout, const VolumeChoice& choice);

}  // namespace wscvt
