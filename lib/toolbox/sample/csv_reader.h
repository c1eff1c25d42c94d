// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wscvt {

/// What separates the fields of a table.
enum class Separator {
  Comma,          ///< of our own tables
  OfFirstRecord,  ///< of a table that others wrote: a semicolon, or else a tab, or else a comma
  OfEachRecord    ///< the same in each record anew
};

/// Reads a CSV file after RFC 4180 record by record, as csv_record writes them. Needs memory for
/// the longest record only. Passes over what spreadsheets write above a table of others: the mark
/// of UTF-8 and a line "sep=;", which names the separator.
class CsvReader {
 public:
  /// The stream must outlive the reader.
  explicit CsvReader(std::istream& stream, Separator separator = Separator::Comma)
      : stream_(stream), choice_(separator) {}

  /// Reads the fields of the next record. Returns false and changes nothing if no complete record
  /// follows.
  bool next(std::vector<std::string>& fields);

  /// The last record as in the file, with its CR LF.
  const std::string& text() const { return text_; }

  /// Line of the stream, from 1, in which the last record begins, or one that is cut.
  std::size_t line() const { return line_; }

  /// Decimal mark besides the point.
  char decimal() const { return separator_ == ',' ? '.' : ','; }

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
  Separator choice_;
  char separator_ = ',';
  std::size_t line_ = 1;
  std::size_t lines_ = 0;  ///< read so far
  std::string text_;
  std::vector<std::string> record_;  ///< room for the next record
  std::size_t size_ = 0;
  bool is_cut_ = false;
  std::string rest_;  ///< of a last record without its line break
};

/// Returns the number in a field; NaN for an empty field and "NA", infinity out of range, nothing
/// for text. `decimal`: the decimal mark besides the point.
std::optional<double> number_in_field(std::string_view field, char decimal);

/// Returns a column of a table with a heading, "" where a record has no such field; nothing if the
/// table cannot be read or has no such column.
std::vector<std::string> column_of(std::istream& table, const std::string& name);

}  // namespace wscvt
