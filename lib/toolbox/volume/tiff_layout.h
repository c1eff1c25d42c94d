// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Meaning of the pages of a TIFF. TIFF itself does not define it; ImageJ, OME and tifffile write
/// it into the text of the first page.
struct TiffLayout {
  /// Dimensions of the pages, the fastest first: slices are Space.
  std::vector<VolumeAxis> axes;
  /// The page of each position in `axes`; empty: they are consecutive.
  std::vector<std::int64_t> pages;
  std::int64_t samples = 1;  ///< numbers per voxel, on one page
  /// Not above 0 if unknown. ImageJ's is along z; x and y come from the resolution.
  Vector3 voxel_size = Vector3::Zero();
  std::string unit;
  /// All voxels are one block after the only page.
  bool may_be_one_block = false;
  std::string writer;  ///< for messages; empty: the file has no description of its pages
  std::vector<std::string> notes;
};

/// Reads the layout of a file `path` with `pages` pages and `samples` numbers per voxel from its
/// first page's text. Throws Error(InputOutput), naming the file, if the text contradicts the
/// pages, or has unknown dimensions or files.
TiffLayout tiff_layout(const std::string& text, std::int64_t pages, std::int64_t samples,
                       const std::string& path);

}  // namespace wscvt
