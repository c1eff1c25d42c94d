// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace wscvt {

// Bytes of a volume in their order, as often as wanted from the beginning: a volume is larger than
// the memory, and what is packed can be read in no other order.

class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Fills `bytes` and returns how many there were: fewer than `count` only at the end.
  virtual std::size_t read(char* bytes, std::size_t count) = 0;

  /// Passes over bytes; over fewer at the end.
  virtual void skip(std::uint64_t count);

  /// Back to the first byte.
  virtual void rewind() = 0;
};

/// The bytes of a file from `offset` on. Throws Error(InputOutput) when it cannot be opened.
std::unique_ptr<ByteSource> file_bytes(const std::string& path, std::uint64_t offset);

/// What the gzip or zlib streams hold that stand one behind the other in `packed`. Reading throws
/// Error(InputOutput), naming the file `path`, when they are damaged.
std::unique_ptr<ByteSource> inflated_bytes(std::unique_ptr<ByteSource> packed, std::string path);

/// The same for bzip2.
std::unique_ptr<ByteSource> bunzipped_bytes(std::unique_ptr<ByteSource> packed, std::string path);

/// What the base64 texts hold that stand one behind the other in `text`, up to the first character
/// that is none of theirs. White space is passed over.
std::unique_ptr<ByteSource> base64_bytes(std::unique_ptr<ByteSource> text);

/// The numbers of a text, between which white space or commas stand, as little-endian doubles of
/// eight bytes, up to a "<" or the end. Reading throws Error(InputOutput), naming the file `path`,
/// for what is no number.
std::unique_ptr<ByteSource> bytes_of_numbers(std::unique_ptr<ByteSource> text, std::string path);

/// Of every `count` blocks of `block` bytes the one at `place`.
std::unique_ptr<ByteSource> picked_bytes(std::unique_ptr<ByteSource> bytes, std::uint64_t block,
                                         std::uint64_t count, std::uint64_t place);

/// What stands behind the first `offset` bytes.
std::unique_ptr<ByteSource> bytes_behind(std::unique_ptr<ByteSource> bytes, std::uint64_t offset);

/// `part` bytes of each of `paths`, one behind the other; `open` gives the bytes of one of them.
/// Reading throws Error(InputOutput), naming the file, where one holds fewer.
std::unique_ptr<ByteSource> joined_bytes(
    std::vector<std::string> paths, std::uint64_t part,
    std::function<std::unique_ptr<ByteSource>(const std::string& path)> open);

/// Size of a file in bytes. Throws Error(InputOutput) when it is not there.
std::uint64_t file_size(const std::string& path);

}  // namespace wscvt
