// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wscvt {

/// A column of numbers of a table of grains.
struct GrainColumn {
  std::string name;  ///< "scan.volume"
  std::string unit;  ///< "length^3"; empty if the heading names none
};

/// Returns the index of a column; nothing if there is none of this name.
std::optional<std::size_t> find_column(const std::vector<GrainColumn>& columns,
                                       std::string_view name);

/// A sample as a table of numbers: a row per grain, a column per measure.
struct GrainTable {
  std::vector<std::string> grains;  ///< names, one per row
  /// The mesh file of each grain, relative to the table's folder; empty if the table names none.
  std::vector<std::string> files;
  std::vector<GrainColumn> columns;
  Eigen::MatrixXd values;  ///< grains x columns; NaN: missing
  std::size_t failed = 0;  ///< rows left out because their status is "failed"
  /// Columns that were left out because their first entry is a text.
  std::vector<std::string> text_columns;
  /// Of these columns, those with numbers, also with decimal commas.
  std::vector<std::string> mixed_columns;

  /// Returns the index of a column; nothing if the table has no such column.
  std::optional<std::size_t> find(std::string_view name) const {
    return find_column(columns, name);
  }

  /// Returns the names of the columns for a message, at most `most`.
  std::string column_names(std::size_t most = 1000000) const;

  /// Returns the index of a column. Throws Error(InvalidInput) with the table's column names if
  /// there is no such column.
  std::size_t index_of(std::string_view name) const;
};

/// Returns a column's heading in a file: "scan.volume [length^3]", or only the name without a unit.
std::string heading_of(const GrainColumn& column);

/// Reads a CSV file (RFC 4180, a heading in the first line) with commas between columns and decimal
/// points. If the heading has a semicolon or a tab, it separates the columns, and decimals have
/// points or commas, as spreadsheets of many languages write them. A line "sep=;" above the heading
/// names the separator.
///
/// The column "grain", or else the first column, names the grains. The column "file" names mesh
/// files. Every other column contains numbers if its first entry is a number, and is left out if
/// that entry is text. An empty field, "nan", "NA" and infinities mean that the number is missing.
/// A heading may end with a unit in square brackets; those of sizes also in round brackets and
/// behind a comma, an underscore, a slash or a blank. Or a row of units follows the headings. A
/// column "unit" has one unit for all rows. Tables of the Sand Atlas, MorphoLibJ and SHAPE are
/// recognised by their headings; their columns get our names and definitions (foreign_columns.h).
/// Rows with the status "failed" (column "status") are counted and left out. The column "error" is
/// left out.
///
/// Memory is about 20 bytes per field. Throws Error with the file and the line. InvalidInput if a
/// row has another number of fields than the heading, a column of numbers contains a text, two
/// columns have one name, no column contains numbers, no row contains a grain, or the file ends
/// within a row. A row is cut if it ends in quotes, or, in a batch's table (with a status), without
/// a line break. InputOutput if the file cannot be read.
GrainTable read_grain_table(const std::string& path);

}  // namespace wscvt
