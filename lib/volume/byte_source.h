// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace wscvt {

// Bytes of a volume in their order, as often as wanted from the beginning: a volume is larger than
// the memory, and what is packed can be read in no other order.

class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Fills `bytes` and returns how many there were: fewer than `count` only at the end.
  virtual std::size_t read(char* bytes, std::size_t count) = 0;

  /// Back to the first byte.
  virtual void rewind() = 0;
};

/// The bytes of a file from `offset` on. Throws Error(InputOutput) when it cannot be opened.
std::unique_ptr<ByteSource> file_bytes(const std::string& path, std::uint64_t offset);

/// What the gzip or zlib streams hold that stand one behind the other in `packed`. Reading throws
/// Error(InputOutput), naming the file `path`, when they are damaged.
std::unique_ptr<ByteSource> inflated_bytes(std::unique_ptr<ByteSource> packed, std::string path);

/// What the base64 texts hold that stand one behind the other in `text`, up to the first character
/// that is none of theirs. White space is passed over.
std::unique_ptr<ByteSource> base64_bytes(std::unique_ptr<ByteSource> text);

/// Size of a file in bytes. Throws Error(InputOutput) when it is not there.
std::uint64_t file_size(const std::string& path);

}  // namespace wscvt
