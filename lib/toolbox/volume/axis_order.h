// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/voxel_rows.h"

namespace wscvt {

/// Dimensions of an array whose file does not say their meaning, in the file's order.
struct ArrayShape {
  std::vector<std::int64_t> counts;  ///< the slowest first, as in NumPy and HDF5
  /// For each dimension, 0, 1, 2 if it is x, y, z; -1: frames; -2: channels. Empty: by convention,
  /// see ShapedVolume.
  std::vector<int> roles = {};
  Vector3 voxel_size = Vector3::Zero();  ///< along x, y, z; not above 0: unknown
  std::string unit;
  std::string size_source = {};        ///< see VolumeGeometry
  std::optional<Vector3> corner = {};  ///< of the first voxel's cell
};

/// A volume's geometry, and the selected part of the array, by the convention of NumPy,
/// scikit-image, napari and Fiji. Dimensions of size one are ignored. The last three of the others
/// are z, y and x; dimensions before them are frames. A last dimension that is shorter than half of
/// each of the three before it, and at most 8, has channels, as colours do.
struct ShapedVolume {
  VolumeGeometry geometry;
  std::vector<VolumeAxis> axes;  ///< the fastest first
  std::vector<BlockPick> picks;
};

/// Returns the geometry and the selection. Throws Error(InputOutput), naming the file `path`, for
/// shapes that are no volume.
ShapedVolume volume_of_shape(const ArrayShape& shape, const VolumeChoice& choice,
                             const std::string& path);

}  // namespace wscvt
