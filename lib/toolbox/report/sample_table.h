// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/open_table.h"

namespace wscvt {

// The table of a sample: CSV (RFC 4180) with one row per grain. Its columns are "grain", the name
// of the scan's file; "status", "done" or "failed"; "error", the message of a failure; then the
// columns of report_csv, empty if the grain failed.

/// Returns the first record.
std::string sample_header();

/// Returns the record of a remeshed grain.
std::string sample_row(const std::string& grain, const RemeshResult& result);

/// Returns the record of a failed grain.
std::string failed_row(const std::string& grain, const std::string& error);

/// These return the records for another report, given as CSV with a header and a row. The first and
/// the last use only its header.
std::string sample_header(const std::string& report);
std::string sample_row(const std::string& grain, const std::string& report);
std::string failed_row(const std::string& grain, const std::string& error,
                       const std::string& report);

/// Returns the message of a failed grain in its record; empty if it did not fail. Also of a table
/// of labels (label_grains.h), whose fourth column is the state of the label and whose fifth is the
/// error.
std::string failure_in(const std::string& record);

/// Such a table, or a table of shapes (shape_table.h), as a growing file. A killed program leaves
/// whole rows and at most one incomplete row, which the next opening removes.
class SampleTable {
 public:
  /// Opens or creates the table of these grains. Throws Error(InvalidInput) if the file has other
  /// columns or rows of other grains. Throws MachineRefused if it cannot be read or written, or if
  /// another process has it open.
  SampleTable(const std::string& path, const std::string& header,
              const std::vector<std::string>& grains);

  /// Number of rows found when opened. They belong to the first grains.
  std::size_t rows() const { return rows_.size(); }
  bool is_failed(std::size_t row) const { return rows_.at(row).failed; }
  /// Number of these rows with failed grains.
  std::size_t failed_rows() const;

  /// Keeps only the first `rows` rows, so that several tables get equal numbers of rows.
  void keep(std::size_t rows);

  /// Adds the record of the next grain. Throws Error(InputOutput).
  void append(const std::string& row);

 private:
  struct Row {
    std::size_t begin;  ///< byte of the file
    bool failed;
  };
  OpenTable table_;
  std::vector<Row> rows_;
};

}  // namespace wscvt
