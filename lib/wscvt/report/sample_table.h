// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/open_table.h"

namespace wscvt {

// The table of a sample, of many grains: CSV after RFC 4180 with a row a grain. Its columns are
// "grain", the name of the scan's file; "status", "done" or "failed"; "error", the sentence of a
// failure; "seconds", where asked for; then those of report_csv, empty for a grain that failed.

/// How long a grain took; nothing where the table has no such column.
using Seconds = std::optional<double>;

/// The first record.
std::string sample_header(bool with_seconds);

/// The record of a grain that was remeshed.
std::string sample_row(const std::string& grain, const RemeshResult& result, Seconds seconds);

/// The record of a grain that was not.
std::string failed_row(const std::string& grain, const std::string& error, Seconds seconds);

/// The same of another report than a remesh's, by its CSV: a header and a row. Of the first and the
/// last only the header counts.
std::string sample_header(const std::string& report, bool with_seconds);
std::string sample_row(const std::string& grain, const std::string& report, Seconds seconds);
std::string failed_row(const std::string& grain, const std::string& error,
                       const std::string& report, Seconds seconds);

/// Such a table, or one of shapes (shape_table.h), as a file that grows. A program that is killed
/// leaves whole rows and at most a part of one, which the next one to open it takes off.
class SampleTable {
 public:
  /// Opens the table of these grains, or begins it. Throws Error(InvalidInput) when the file has
  /// other columns or rows of other grains, and MachineRefused when it cannot be read or written,
  /// or another process has it open.
  SampleTable(const std::string& path, const std::string& header,
              const std::vector<std::string>& grains);

  /// Rows that were there when it was opened: those of the first so many grains.
  std::size_t rows() const { return rows_.size(); }
  /// How many of them are of grains that failed.
  std::size_t failed_rows() const;

  /// Takes off the rows after the first so many. For tables that are to have as many rows.
  void keep(std::size_t rows);

  /// Adds the record of the next grain. Throws Error(InputOutput).
  void append(const std::string& row);

 private:
  void read(const std::string& header, const std::vector<std::string>& grains);

  struct Row {
    std::size_t begin;  ///< byte of the file
    bool failed;
  };
  OpenTable table_;
  std::vector<Row> rows_;
};

/// Joins tables of parts of a sample, whole ones with the same columns, into one whose rows are in
/// the order of the grains' names, so that it is the same however the sample was parted. Throws
/// Error: InvalidInput when columns differ, a table ends within a row, or a grain has two rows that
/// differ; InputOutput.
void join_tables(const std::vector<std::string>& tables, const std::string& joined);

}  // namespace wscvt
