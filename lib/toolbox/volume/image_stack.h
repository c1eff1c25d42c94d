// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
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

/// A slice, unpacked.
struct SliceImage {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::string numbers;        ///< of each voxel, for messages: "3 x 8 bits"
  std::size_t channels = 1;   ///< numbers of each voxel
  std::size_t bytes = 1;      ///< of each number, the most significant first
  std::vector<char> content;  ///< rows from above
};

/// Reads a file; without `content` only its form. Throws Error(InputOutput), naming it.
using ReadSlice = SliceImage (*)(const std::string& path, bool with_content);

/// Opens slices that are files of one image each, in the same way. Without a chosen channel, three
/// equal colours are one, and transparency is no channel of labels.
std::unique_ptr<LabelVolume> open_images(const SliceFiles& slices, const VolumeChoice& choice,
                                         ReadSlice read);

/// Opens slices that are PNG files, in the same way.
std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice& choice);

/// Opens slices that are BMP files, of 8 bits or of three equal colours, in the same way.
std::unique_ptr<LabelVolume> open_bmp_slices(const SliceFiles& slices, const VolumeChoice& choice);

}  // namespace wscvt
