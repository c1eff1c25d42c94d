// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "volume/label_volume.h"
#include "volume/voxel_rows.h"

namespace wscvt {

/// Dimensions of an array, whose file does not say what they are, as they stand in the file.
struct ArrayShape {
  std::vector<std::int64_t> counts;  ///< the slowest first, as NumPy and HDF5 name them
  /// Which dimensions are x, y and z (0, 1, 2); -1: none of space. Empty: by habit, see
  /// volume_of_shape.
  std::vector<int> roles = {};
  Vector3 voxel_size = Vector3::Zero();  ///< along x, y, z; not above 0: it is not said
  std::string unit;
};

/// A volume's geometry, and what is taken of the array, by the habit of NumPy, scikit-image, napari
/// and Fiji: dimensions of one place count for nothing; of those that are left the last three are
/// z, y and x, and others before them are frames.
struct ShapedVolume {
  VolumeGeometry geometry;
  std::vector<VolumeAxis> axes;  ///< the fastest first
  std::vector<BlockPick> picks;
};

/// Throws Error(InputOutput), naming the file `path`, for shapes that are no volume.
ShapedVolume volume_of_shape(const ArrayShape& shape, const VolumeChoice& choice,
                             const std::string& path);

}  // namespace wscvt
