// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "volume/volume_choice.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What the pages of a TIFF are, which TIFF itself does not say: ImageJ, OME and tifffile write it
/// into the text of the first page.
struct TiffLayout {
  /// Dimensions of the pages, the one that changes from page to page first: slices are Space.
  std::vector<VolumeAxis> axes;
  /// The page of each place in `axes`; empty: they follow each other.
  std::vector<std::int64_t> pages;
  std::int64_t samples = 1;  ///< numbers a voxel, of the same page
  /// Of a voxel; not above 0 where it is not said. ImageJ's is along z, x and y are the
  /// resolution's.
  Vector3 voxel_size = Vector3::Zero();
  std::string unit;
  /// All voxels stand in one block behind the only page.
  bool may_be_one_block = false;
  std::string writer;  ///< for sentences; empty: the file says nothing of its pages
  std::vector<std::string> notes;
};

/// Reads what a file `path` with so many pages, and `samples` numbers a voxel, says in its first
/// page's text. Throws Error(InputOutput), naming the file, where that contradicts the pages, or
/// tells of dimensions or files that are not known.
TiffLayout tiff_layout(const std::string& text, std::int64_t pages, std::int64_t samples,
                       const std::string& path);

}  // namespace wscvt
