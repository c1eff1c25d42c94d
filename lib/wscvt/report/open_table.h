// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace wscvt {

namespace system_files {
class LockedFile;
}

enum class TableUse {
  Read,
  Append,       ///< creates the file if missing; waits while another process has it
  AppendAlone,  ///< throws if another process has it
};

/// An open CSV file, locked against other writers until this object is destroyed. If the file
/// system has no locks, the rows are still complete as long as one process writes. This header is
/// not public.
class OpenTable {
 public:
  /// Throws MachineRefused if the file cannot be opened, or for AppendAlone if another process has
  /// it.
  OpenTable(std::string path, TableUse use);
  OpenTable(const OpenTable&) = delete;
  OpenTable& operator=(const OpenTable&) = delete;
  ~OpenTable();

  const std::string& path() const { return path_; }

  /// In bytes. Throws MachineRefused, like all functions below.
  std::size_t size() const;

  /// Reads up to `size` bytes at `from`.
  std::string read(std::size_t from, std::size_t size) const;

  /// Writes at the end: all or nothing.
  void append(const std::string& bytes) const;

  /// Truncates the file to its first `size` bytes.
  void cut(std::size_t size) const;

 private:
  std::string path_;
  std::unique_ptr<system_files::LockedFile> file_;
};

/// Writes a header and a row (see report_csv) to a new or empty file. If the file is a table with
/// this header, appends only the row. Pipes and devices always get both. Writes all or nothing.
/// Several processes may append to one table. Throws Error(InvalidInput) if the file has another
/// header or ends within a row, and leaves it unchanged. Throws Error(InputOutput) if it cannot be
/// read or written.
void append_to_table(const std::string& path, const std::string& header_and_row);

/// Checks the file and its header before the work, and throws the errors of append_to_table. Writes
/// nothing. `header_and_row` may contain any row.
void check_table(const std::string& path, const std::string& header_and_row);

}  // namespace wscvt
