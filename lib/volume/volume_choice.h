// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

// What a file holds beside one volume of labels, and which of it is taken. A dimension that is not
// space is never read as slices: where a file has more than one channel, frame or array and none
// was chosen, it is refused with their names.

/// What is asked of a file of voxels.
struct VolumeChoice {
  std::optional<Vector3> voxel_size;    ///< along x, y and z, in place of the file's; length
  std::string unit;                     ///< of `voxel_size`, as unit_of gives it; empty: the file's
  std::optional<std::int64_t> channel;  ///< from 1
  std::optional<std::int64_t> frame;    ///< a point in time, from 1
  std::string array;  ///< name of an array, path of a data set; empty: the only one
};

/// What a dimension of a file is.
enum class AxisKind { Space, Channel, Frame };

/// A dimension of a file.
struct VolumeAxis {
  AxisKind kind = AxisKind::Space;
  std::int64_t count = 1;
};

/// The place, from 0, that is taken of a dimension that is not space. Throws Error(InputOutput),
/// naming the file `path`, when it has more than one and none was chosen, or not the one that was.
std::int64_t chosen_place(const VolumeAxis& axis, const VolumeChoice& choice,
                          const std::string& path);

/// The place of the chosen name among `names`, which are not empty. Throws Error(InputOutput)
/// likewise.
std::size_t chosen_array(const std::vector<std::string>& names, const VolumeChoice& choice,
                         const std::string& path);

/// Of every `count` blocks of `block` elements that follow each other, the one at `place`.
struct BlockPick {
  std::int64_t block = 1;
  std::int64_t count = 1;
  std::int64_t place = 0;
};

/// What is taken of a file whose dimensions are `axes`, the one that changes fastest first, in the
/// order in which it is taken. Throws as chosen_place does, and Error(InputOutput) when a product
/// of counts is more than a file holds.
std::vector<BlockPick> picks_of(const std::vector<VolumeAxis>& axes, const VolumeChoice& choice,
                                const std::string& path);

/// A unit of length as tables and pages show it: "um" for its many names (µm, micron,
/// micrometer, ...), likewise "nm", "mm", "cm", "m" and "inch"; empty for pixels and voxels, which
/// are no unit; any other text as it is.
std::string unit_of(const std::string& text);

/// Whether unit_of knows the text as a unit of length.
bool is_known_unit(const std::string& text);

}  // namespace wscvt
