// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wscvt::program {

/// The files that the inputs of a batch name, in their order: files; the meshes in folders, and
/// what patterns (*, ?, [...]) match, by name; of "@list" the lines of the file, each an input. A
/// folder of slices is a volume, as it stands. A file need not be there. Throws wscvt::Error for
/// folders without meshes or slices, patterns that match nothing and lists that cannot be read.
std::vector<std::string> grain_files(const std::vector<std::string>& inputs);

/// Whether an input of a batch names files rather than being one: a folder, a pattern or a list.
bool names_files(const std::string& input);

/// A part of a sample: the `index`-th, from 1, of `count`.
struct Shard {
  int index = 1;
  int count = 1;
};

/// Of "I/N". Throws wscvt::Error(InvalidInput).
Shard shard_of(std::string_view text);

/// FNV-1a of 64 bits (Fowler, Noll, Vo): the same on every machine.
std::uint64_t stable_hash(std::string_view bytes);

/// Whether a grain is in a part, by the hash of its name without folders: on every machine, and
/// whatever else is in the sample, it is in the same part.
bool is_of(const Shard& shard, const std::string& grain);

}  // namespace wscvt::program
