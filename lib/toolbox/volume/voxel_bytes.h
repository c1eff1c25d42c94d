// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "wscvt/mesh_files/byte_source.h"

namespace wscvt {

/// Opens bytes at their beginning.
using OpenBytes = std::function<std::unique_ptr<ByteSource>()>;

/// Returns the bytes of a file from `offset` on. Throws Error(InputOutput) if it cannot be opened.
std::unique_ptr<ByteSource> file_bytes(const std::string& path, std::uint64_t offset);

/// Returns the unpacked bytes of consecutive gzip or zlib streams in `packed`. Reading throws
/// Error(InputOutput), naming the file `path`, if they are damaged.
std::unique_ptr<ByteSource> inflated_bytes(std::unique_ptr<ByteSource> packed, std::string path);

/// Reads the numbers of a text, separated by white space or commas, up to a "<" or the end, as
/// little-endian doubles of eight bytes. Reading throws Error(InputOutput), naming the file `path`,
/// for other text.
std::unique_ptr<ByteSource> bytes_of_numbers(std::unique_ptr<ByteSource> text, std::string path);

/// Returns block number `place` of every `count` blocks of `block` bytes.
std::unique_ptr<ByteSource> picked_bytes(std::unique_ptr<ByteSource> bytes, std::uint64_t block,
                                         std::uint64_t count, std::uint64_t place);

/// Opens the bytes of a file.
using OpenFile = std::function<std::unique_ptr<ByteSource>(const std::string& path)>;

/// Returns the first `part` bytes of each of `paths`, one after the other. Reading throws
/// Error(InputOutput), naming the file, if a file has fewer.
std::unique_ptr<ByteSource> joined_bytes(std::vector<std::string> paths, std::uint64_t part,
                                         OpenFile open);

/// Returns the size of a file in bytes. Throws Error(InputOutput) if it does not exist.
std::uint64_t file_size(const std::string& path);

}  // namespace wscvt
