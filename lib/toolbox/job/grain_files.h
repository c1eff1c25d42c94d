// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace wscvt {

/// Returns the files of the inputs of a job, in the order of the inputs. A file is itself. A folder
/// gives its meshes, and a pattern (*, ?, [...]) its matches, both sorted by name. "@list" gives
/// the lines of the file, each an input. What `is_volume` accepts, such as a folder of slices, is
/// one file; if it is empty, there are no volumes. A file need not exist. Throws wscvt::Error for
/// folders without meshes or slices, patterns without matches, and lists that cannot be read.
std::vector<std::string> grain_files(const std::vector<std::string>& inputs,
                                     const std::function<bool(const std::string& path)>& is_volume);

/// Returns whether an input of a job is a folder, a pattern or a list.
bool names_files(const std::string& input);

/// Throws Error(InvalidInput) for an ending of files, without the point, that is none of a mesh.
void check_format(const std::string& ending);

/// Part `index`, from 1, of `count` parts of a sample.
struct Shard {
  int index = 1;
  int count = 1;
};

/// Reads "I/N". Throws wscvt::Error(InvalidInput).
Shard shard_of(std::string_view text);

/// Returns whether a grain is in a part, by the 64-bit FNV-1a hash (Fowler, Noll, Vo) of its name
/// without folders. The part does not
/// depend on the machine or on the other grains of the sample.
bool is_of(const Shard& shard, const std::string& grain);

}  // namespace wscvt
