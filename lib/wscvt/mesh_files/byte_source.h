// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace wscvt {

/// Bytes in their order. A volume is larger than the memory, and packed data can be read in no
/// other order: to read them again, they are opened again.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Fills `bytes` and returns the number of bytes read: fewer than `count` only at the end.
  virtual std::size_t read(char* bytes, std::size_t count) = 0;

  /// Skips bytes; fewer at the end.
  virtual void skip(std::uint64_t count);
};

/// Bytes in memory, which must remain.
class MemoryBytes : public ByteSource {
 public:
  explicit MemoryBytes(std::string_view bytes) : bytes_(bytes) {}

  std::size_t read(char* bytes, std::size_t count) override {
    const std::size_t filled = bytes_.copy(bytes, count);
    bytes_.remove_prefix(filled);
    return filled;
  }

 private:
  std::string_view bytes_;  ///< those left
};

/// Bytes that are made from others, some at a time.
class MadeBytes : public ByteSource {
 public:
  std::size_t read(char* bytes, std::size_t count) override;

 private:
  /// Puts the next bytes into `made`, which is empty. Returns false at the end.
  virtual bool make(std::vector<char>& made) = 0;

  std::vector<char> made_;
  std::size_t next_ = 0;  ///< position in made_
};

/// The characters of a text, one after the other.
class Characters {
 public:
  explicit Characters(std::unique_ptr<ByteSource> text);

  /// Returns the next character, which stays the next one; -1 at the end.
  int peek() {
    return begin_ == end_ && !fill() ? -1 : static_cast<unsigned char>(buffer_[begin_]);
  }
  int next() {
    const int c = peek();
    if (c >= 0) ++begin_;
    return c;
  }

  /// Skips the characters up to the first `c`, and it. Returns false if there is none.
  bool skip_past(char c);

  /// Returns the number of characters before the next one.
  std::uint64_t offset() const { return passed_ + begin_; }

 private:
  bool fill();

  std::unique_ptr<ByteSource> text_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t passed_ = 0;  ///< before the buffer
};

}  // namespace wscvt
