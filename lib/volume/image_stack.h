// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "volume/label_volume.h"

namespace wscvt {

// A folder of slices, an image each: TIFF or PNG.

/// Files that systems put beside others, which nobody sees: "._s03.tif", "Thumbs.db", ".DS_Store".
bool is_foreign_file(const std::string& name);

/// Whether a name is one of a slice, by its ending.
bool is_slice(const std::string& name);

/// The slices of a volume.
struct SliceFiles {
  std::string folder;              ///< or the file, where all are in one
  std::vector<std::string> paths;  ///< in the order of the numbers in their names
};

/// Slices that are files of one page, or pages of the only file. Throws as open_volume does, and
/// Error(InputOutput) naming the first slice that is of another size or type than those before it.
std::unique_ptr<LabelVolume> open_tiff_slices(const SliceFiles& slices, const VolumeChoice& choice);

/// The same of files of PNG.
std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice& choice);

}  // namespace wscvt
