// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

// Selects one volume of labels from a file. A dimension that is not space is never read as slices.
// If a file has more than one channel, frame or array and none was chosen, it is refused with their
// names.

/// The user's selection in a file of voxels.
struct VolumeChoice {
  std::optional<Vector3> voxel_size;    ///< along x, y and z, replaces the file's; length
  std::string unit;                     ///< of `voxel_size`, as unit_of gives it; empty: the file's
  std::optional<std::int64_t> channel;  ///< from 1
  std::optional<std::int64_t> frame;    ///< a point in time, from 1
  std::string array;  ///< name of an array, path of a data set; empty: the only one
};

/// Throws Error(InputOutput) for a file that is no such volume: "path" + what, and what to do.
[[noreturn]] void refuse_volume(const std::string& path, const Sentence& what);

/// Throws it for a file whose library is not in this build, such as Python's module, which has none
/// of them. `package`: Debian's, with which the program reads the file.
[[noreturn]] void refuse_without(const std::string& path, const std::string& library,
                                 const std::string& package);

/// Kind of a dimension of a file.
enum class AxisKind { Space, Channel, Frame };

/// A dimension of a file.
struct VolumeAxis {
  AxisKind kind = AxisKind::Space;
  std::int64_t count = 1;
};

/// Returns the selected index, from 0, in a dimension that is not space. Throws Error(InputOutput),
/// naming the file `path`, if it has more than one and none was chosen, or lacks the chosen one.
std::int64_t chosen_place(const VolumeAxis& axis, const VolumeChoice& choice,
                          const std::string& path);

/// Returns the index of the chosen name among `names`, which are not empty. Throws
/// Error(InputOutput) likewise.
std::size_t chosen_array(const std::vector<std::string>& names, const VolumeChoice& choice,
                         const std::string& path);

/// Selects block number `place` of every `count` consecutive blocks of `block` elements.
struct BlockPick {
  std::int64_t block = 1;
  std::int64_t count = 1;
  std::int64_t place = 0;
};

/// Returns the selections for a file with the dimensions `axes`, the fastest first, in the order in
/// which they apply. Throws as chosen_place does, and Error(InputOutput) if a product of counts is
/// larger than any file.
std::vector<BlockPick> picks_of(const std::vector<VolumeAxis>& axes, const VolumeChoice& choice,
                                const std::string& path);

/// Returns a unit of length for tables and pages: "um" for its many names (µm, micron, micrometer,
/// ...), likewise "nm", "mm", "cm", "m" and "inch"; empty for pixels and voxels, which are no
/// units; any other text unchanged.
std::string unit_of(const std::string& text);

/// Returns whether unit_of knows the text as a unit of length.
bool is_known_unit(const std::string& text);

}  // namespace wscvt
