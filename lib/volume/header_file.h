// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// The lines at the beginning of a file, before its voxels.
class HeaderFile {
 public:
  /// Begins at the byte `begin`. Throws Error(InputOutput) when the file cannot be opened.
  explicit HeaderFile(const std::string& path, std::uint64_t begin = 0);

  /// The next line, without white space at its ends. Throws Error(InputOutput) where the file ends,
  /// and after more lines or longer ones than a header has.
  std::string line();

  bool is_at_end() const { return reader_.remaining() == 0; }

  /// Bytes up to the end of the line read last.
  std::uint64_t offset() const { return size_ - reader_.remaining(); }
  std::uint64_t size() const { return size_; }

  /// Throws Error(InputOutput), naming the line read last.
  [[noreturn]] void fail_line(const std::string& what) const { reader_.fail_line(what); }

 private:
  std::uint64_t size_;
  std::ifstream stream_;
  ByteReader reader_;
};

/// The numbers of a text, between which stand blanks, commas and brackets. Throws
/// Error(InputOutput), naming the line, where one is none.
std::vector<double> numbers_in(std::string_view text, const HeaderFile& file);

/// The same for three of them.
Vector3 vector_in(std::string_view text, const HeaderFile& file);

/// A whole number. Throws Error(InputOutput), naming the line.
std::int64_t whole_number_of(std::string_view text, const HeaderFile& file);

}  // namespace wscvt
