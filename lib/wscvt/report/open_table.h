// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace wscvt {

enum class TableUse {
  Read,
  Append,       ///< made if it is not there; waits while another has it
  AppendAlone,  ///< refuses what another has
};

/// A file of rows that is open, and nobody else's to append to until its end of scope. Where files
/// cannot be locked, rows of one process at a time are whole all the same. Not one of the library's
/// public headers.
class OpenTable {
 public:
  /// Throws MachineRefused when it cannot be opened, and when it is to be appended to alone and
  /// another has it.
  OpenTable(std::string path, TableUse use);
  OpenTable(const OpenTable&) = delete;
  OpenTable& operator=(const OpenTable&) = delete;
  ~OpenTable();

  const std::string& path() const { return path_; }

  /// In bytes. Throws MachineRefused, as all that follows.
  std::size_t size() const;

  /// As much as there is of `size` bytes at `from`.
  std::string read(std::size_t from, std::size_t size) const;

  /// At the end: all of it or nothing.
  void append(const std::string& bytes) const;

  /// Takes off what stands behind the first `size` bytes.
  void cut(std::size_t size) const;

 private:
  std::string path_;
  int descriptor_;
};

}  // namespace wscvt
