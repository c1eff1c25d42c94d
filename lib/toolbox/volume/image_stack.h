// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/volume_choice.h"

namespace wscvt {

// A folder of slices, each an image: TIFF, PNG or BMP.

/// Returns whether a file is a hidden one from a system: "._s03.tif", "Thumbs.db", ".DS_Store".
bool is_foreign_file(const std::string& name);

/// Returns whether a name is a slice's, by its ending.
bool is_slice(const std::string& name);

/// The slices of a volume.
struct SliceFiles {
  std::string folder;              ///< or the file, if it contains all slices
  std::vector<std::string> paths;  ///< in the order of the numbers in their names
};

/// Opens slices that are files of one page, or the pages of the only file. Throws as open_volume
/// does, and Error(InputOutput) naming the first slice whose size or type differs from the previous
/// ones.
std::unique_ptr<LabelVolume> open_tiff_slices(const SliceFiles& slices, const VolumeChoice& choice);

/// Opens slices that are PNG files, in the same way.
std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice& choice);

/// Opens slices that are BMP files, of 8 bits or of three equal colours, in the same way.
std::unique_ptr<LabelVolume> open_bmp_slices(const SliceFiles& slices, const VolumeChoice& choice);

}  // namespace wscvt
