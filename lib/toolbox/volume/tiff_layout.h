// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/error.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Meaning of the pages of a TIFF. TIFF itself does not define it; ImageJ, OME and tifffile write
/// it into the text of the first page.
struct TiffLayout {
  /// Dimensions of the pages, the fastest first: slices are Space.
  std::vector<VolumeAxis> axes;
  /// The page of each position in `axes`; empty: they are consecutive.
  std::vector<std::int64_t> pages;
  /// Not above 0 if unknown. ImageJ's and tifffile's is along z; x and y come from the resolution.
  Vector3 voxel_size = Vector3::Zero();
  std::string unit;
  std::string other_unit;  ///< of one axis only; empty: none has another
  std::string differing;   ///< name of a slice's file that says another size; empty: none does
  /// All voxels are one block after the only page.
  bool may_be_one_block = false;
  std::int64_t offset = 0;      ///< to be added to each number
  std::string writer;           ///< for messages; empty: the file has no description of its pages
  std::vector<Sentence> notes;  ///< on the size of voxels
  std::vector<Sentence> more_notes;  ///< on other things
};

/// The pages of a TIFF that are slices.
struct TiffPageShape {
  std::int64_t width = 1;
  std::int64_t height = 1;
  std::int64_t samples = 1;  ///< numbers per voxel
  std::int64_t in_file = 1;  ///< number of the last of them in the file, from 1
};

/// Reads what the text of one of many slices, the file `path`, says of all: OME's size of voxels,
/// or ImageJ's unit, distance of slices and calibration. Of another text nothing: the slice is no
/// stack. Throws as tiff_layout does.
TiffLayout slice_layout(const std::string& description, const std::string& path);

/// Throws Error(InputOutput), naming the file, if OME's text of the first of these slices places
/// them in another order, or in several channels or frames.
void check_ome_slices(const std::string& text, const std::vector<std::string>& paths);

/// Reads the layout of a file `path` with `pages` pages of slices from its first page's text.
/// Throws Error(InputOutput), naming the file, if the text contradicts the pages, or has unknown
/// dimensions or files.
TiffLayout tiff_layout(const std::string& text, std::int64_t pages, const TiffPageShape& page,
                       const std::string& path);

}  // namespace wscvt
