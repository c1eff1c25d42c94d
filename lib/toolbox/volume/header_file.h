// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/input_file.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads the lines at the beginning of a file, before its voxels.
class HeaderFile {
 public:
  /// Begins at the byte `begin`. Throws Error(InputOutput) if the file cannot be opened.
  explicit HeaderFile(const std::string& path, std::uint64_t begin = 0);

  /// Returns the next line, without white space at its ends. Throws Error(InputOutput) at the end
  /// of the file, and for more or longer lines than a header has.
  std::string line();

  /// Returns the lines that are left and not empty.
  std::vector<std::string> other_lines();

  bool is_at_end() const { return reader_.remaining() == 0; }

  /// Returns the number of bytes up to the end of the last line read.
  std::uint64_t offset() const { return size_ - reader_.remaining(); }
  std::uint64_t size() const { return size_; }

  /// Throws Error(InputOutput), naming the last line read.
  [[noreturn]] void fail_line(const std::string& what) const { reader_.refuse_line(what); }

 private:
  std::uint64_t size_;
  InputFile stream_;
  ByteReader reader_;
};

/// Returns the numbers of a text, separated by blanks, commas and brackets. Throws
/// Error(InputOutput), naming the line, for other text.
std::vector<double> numbers_in(std::string_view text, const HeaderFile& file);

/// Returns three such numbers.
Vector3 vector_in(std::string_view text, const HeaderFile& file);

/// Returns the whole numbers of a text, separated by blanks. Throws Error(InputOutput) likewise.
std::vector<std::int64_t> whole_numbers_in(std::string_view text, const HeaderFile& file);

/// Returns a whole number. Throws Error(InputOutput), naming the line.
std::int64_t whole_number_of(std::string_view text, const HeaderFile& file);

}  // namespace wscvt
