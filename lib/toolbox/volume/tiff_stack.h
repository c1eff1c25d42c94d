// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/tiff_pages.h"

namespace wscvt {

/// A slice: a page of a file.
struct SlicePage {
  std::size_t file = 0;
  std::uint32_t page = 0;
};
/// Returns the volume of slices that are pages of one file, or files of one page. `sample`: number
/// of the selected sample of each voxel. Its rows throw Error(InputOutput), naming the file, for a
/// page unlike `page` or damaged, for colours that are not equal and for an alpha that is not
/// constant.
std::unique_ptr<LabelVolume> volume_of_slices(const VolumeGeometry& geometry, const TiffPage& page,
                                              std::int64_t sample, std::vector<std::string> files,
                                              std::vector<SlicePage> slices);

}  // namespace wscvt
