// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace wscvt {

/// Reads a CSV file after RFC 4180 record by record, as csv_record writes them. Needs memory for
/// the longest record only.
class CsvReader {
 public:
  /// The stream must outlive the reader. Spreadsheets in some languages separate fields by ';'.
  explicit CsvReader(std::istream& stream, char separator = ',')
      : stream_(stream), separator_(separator) {}

  /// Reads the fields of the next record. Returns false and changes nothing if no complete record
  /// follows.
  bool next(std::vector<std::string>& fields);

  /// The last record as in the file, with its CR LF.
  const std::string& text() const { return text_; }

  /// Bytes of all whole records so far.
  std::size_t size() const { return size_; }

  /// Whether the stream ended within a record.
  bool is_cut() const { return is_cut_; }

  /// Reads the fields of a last record that lacks only its line break. Returns false and changes
  /// nothing if there is no such record or a quote is open.
  bool last(std::vector<std::string>& fields);

 private:
  void take(const std::string& record, std::vector<std::string>& fields);

  std::istream& stream_;
  char separator_;
  std::string text_;
  std::vector<std::string> record_;  ///< room for the next record
  std::size_t size_ = 0;
  bool is_cut_ = false;
  std::string rest_;  ///< of a last record without its line break
};

/// Returns a column of a table with a heading, "" where a record has no such field; nothing if the
/// table cannot be read or has no such column.
std::vector<std::string> column_of(std::istream& table, const std::string& name);

}  // namespace wscvt
