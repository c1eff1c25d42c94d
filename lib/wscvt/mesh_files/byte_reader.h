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

/// Reads a file in order through one buffer: records of binary files, lines of text files. The
/// buffer grows only to the size of a record or line, never beyond the size of the file. Callers
/// therefore compare a count from a file with `remaining` before they allocate memory for it.
class ByteReader {
 public:
  /// Reads `stream` from its beginning; it has `size` bytes. `path` is for messages. Reports
  /// progress per buffer, some milliseconds of text, so functions that read may throw
  /// Error(Cancelled).
  ByteReader(std::istream& stream, std::uintmax_t size, std::string path,
             Execution execution = Execution(1));

  /// Returns the number of bytes not read yet.
  std::uintmax_t remaining() const { return unread_ + (end_ - begin_); }

  /// Reads the next `count` bytes; they are valid until the next call. Returns null if fewer are
  /// left.
  const char* next(std::size_t count) {
    if (end_ - begin_ < count && !fill(count)) return nullptr;
    const char* const bytes = buffer_.data() + begin_;
    begin_ += count;
    return bytes;
  }

  /// Skips `count` bytes. Returns false if fewer bytes are left.
  bool skip(std::uintmax_t count);

  /// Returns at most `count` of the next bytes and does not consume them.
  std::string_view peek(std::size_t count);

  /// Reads the next line without its line break; it is valid until the next call. Returns nothing
  /// at the end of the file. All lines end as the first line: LF, CR LF or CR. Skips a byte-order
  /// mark.
  std::optional<std::string_view> line();

  /// Reads the next line that is not blank.
  std::optional<std::string_view> filled_line();

  /// Returns the number of the line read last, from 1.
  std::size_t line_number() const { return line_number_; }

  /// Adds a warning about a harmless fault of the file: "path" + what.
  void warn(const std::string& what) { warnings_.push_back("\"" + path_ + "\" " + what); }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Throws Error(InputOutput): "path" + what, which ends with advice.
  [[noreturn]] void refuse(const std::string& what) const;

  /// Throws as `refuse`, naming the line read last.
  [[noreturn]] void refuse_line(const std::string& what) const;

  /// Throw as the functions above for wrong content, with the advice to export the file again.
  [[noreturn]] void fail(const std::string& what) const { refuse(what + export_again); }
  [[noreturn]] void fail_line(const std::string& what) const { refuse_line(what + export_again); }

  /// Throws as `refuse` if things cannot be numbered. `more`: such as "has more points".
  void check_count(std::uintmax_t count, const char* more) const;

  /// Throws as fail_line: it has `field` instead of `due`.
  [[noreturn]] void fail_field(std::string_view field, const std::string& due) const;

 private:
  static constexpr const char* export_again = ". Export it again from the program it came from.";

  bool fill(std::size_t count);

  std::istream& stream_;
  std::string path_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uintmax_t size_;
  std::uintmax_t unread_;  ///< bytes left in the stream
  std::size_t line_number_ = 0;
  char line_end_ = '\n';
  std::vector<std::string> warnings_;
  Execution execution_;
};

/// Returns a number of a binary file.
template <class Value, boost::endian::order Order>
Value load(const char* bytes) {
  return boost::endian::endian_load<Value, sizeof(Value), Order>(
      reinterpret_cast<const unsigned char*>(bytes));
}

/// The types of numbers in binary files.
enum class Stored { Int8, Uint8, Int16, Uint16, Int32, Uint32, Int64, Uint64, Float32, Float64 };

/// Returns the number of bytes of a type.
inline std::size_t size_of(Stored type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

/// Returns a number of a binary file.
template <class Number>
Number load_as(Stored type, boost::endian::order order, const char* bytes) {
  const auto read = [&](auto zero) {
    using Value = decltype(zero);
    return static_cast<Number>(order == boost::endian::order::little
                                   ? load<Value, boost::endian::order::little>(bytes)
                                   : load<Value, boost::endian::order::big>(bytes));
  };
  switch (type) {
    // NOLINTNEXTLINE(bugprone-branch-clone): each reads another type
    case Stored::Int8:
      return read(std::int8_t());
    case Stored::Uint8:
      return read(std::uint8_t());
    case Stored::Int16:
      return read(std::int16_t());
    case Stored::Uint16:
      return read(std::uint16_t());
    case Stored::Int32:
      return read(std::int32_t());
    case Stored::Uint32:
      return read(std::uint32_t());
    case Stored::Int64:
      return read(std::int64_t());
    case Stored::Uint64:
      return read(std::uint64_t());
    case Stored::Float32:
      return read(float());
    case Stored::Float64:
      break;
  }
  return read(double());
}

/// Whether a file begins as a gzip file.
bool is_gzip(const std::string& path);

/// Returns the unpacked content of a gzip file. Throws Error(InputOutput) if it cannot be read, is
/// cut or damaged; Error(Cancelled).
std::string gzip_content(const std::string& path, const Execution& execution);

}  // namespace wscvt
