// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/endian/conversion.hpp>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Bytes of a file in order, through one buffer: records of binary files, lines of text files. The
/// buffer grows only to what a record or line takes, and never beyond the bytes that the file
/// holds: a count that a file claims is therefore compared with `remaining` before anything is made
/// of it.
class ByteReader {
 public:
  /// Reads `stream`, which holds `size` bytes and stands at its beginning; `path` is for sentences.
  /// Progress is reported from buffer to buffer, some milliseconds of text: what reads may throw
  /// Error(Cancelled).
  ByteReader(std::istream& stream, std::uintmax_t size, std::string path,
             Execution execution = Execution(1));

  /// Bytes that are not read yet.
  std::uintmax_t remaining() const { return unread_ + (end_ - begin_); }

  /// The next `count` bytes, valid until the next call; null when fewer are left.
  const char* next(std::size_t count) {
    if (end_ - begin_ < count && !fill(count)) return nullptr;
    const char* const bytes = buffer_.data() + begin_;
    begin_ += count;
    return bytes;
  }

  /// As `next`, for what is not needed; false when fewer bytes are left.
  bool skip(std::uintmax_t count);

  /// At most `count` of the next bytes, which stay to be read.
  std::string_view peek(std::size_t count);

  /// The next line without its end, valid until the next call; nothing at the end of the file.
  /// Lines end as the first of them does: LF, CR LF or CR. A byte-order mark is passed over.
  std::optional<std::string_view> line();

  /// The next line that holds more than white space.
  std::optional<std::string_view> filled_line();

  /// Number of the line read last, from 1.
  std::size_t line_number() const { return line_number_; }

  /// Notes what is odd about the file and does no harm: "path" + what.
  void warn(const std::string& what) { warnings_.push_back("\"" + path_ + "\" " + what); }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Throws Error(InputOutput): "path" + what.
  [[noreturn]] void fail(const std::string& what) const;

  /// Throws Error(InputOutput), naming the line read last.
  [[noreturn]] void fail_line(const std::string& what) const;

 private:
  bool fill(std::size_t count);

  std::istream& stream_;
  std::string path_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uintmax_t size_;
  std::uintmax_t unread_;  ///< in the stream
  std::size_t line_number_ = 0;
  char line_end_ = '\n';
  std::vector<std::string> warnings_;
  Execution execution_;
};

/// A number of a binary file.
template <class Value, boost::endian::order Order>
Value load(const char* bytes) {
  return boost::endian::endian_load<Value, sizeof(Value), Order>(
      reinterpret_cast<const unsigned char*>(bytes));
}

/// What to do about a file that does not hold what it should.
inline constexpr const char* export_again = ". Export it again from the program it came from.";

}  // namespace wscvt
