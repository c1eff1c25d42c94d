// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/csv_reader.h"

#include <algorithm>
#include <istream>
#include <string_view>
#include <utility>

namespace wscvt {

namespace {

/// Returns the next field of a record. Keeps its old text, to reuse the memory.
std::string& begin_field(std::vector<std::string>& fields, std::size_t& count) {
  if (count == fields.size()) fields.emplace_back();
  fields[count].clear();
  return fields[count++];
}

/// Splits a record without quotes. Returns the number of fields.
std::size_t split(std::string_view record, char separator, std::vector<std::string>& fields) {
  std::size_t count = 0;
  record.remove_suffix(1);
  while (true) {
    const std::size_t end = record.find(separator);
    const std::string_view text = record.substr(0, end);
    std::string& field = begin_field(fields, count);
    field = text;
    field.erase(std::remove(field.begin(), field.end(), '\r'), field.end());
    if (end == std::string_view::npos) return count;
    record.remove_prefix(end + 1);
  }
}

/// Splits a record with quotes.
std::size_t split_quoted(std::string_view record, char separator,
                         std::vector<std::string>& fields) {
  std::size_t count = 0;
  std::string* field = &begin_field(fields, count);
  bool quoted = false;
  for (std::size_t k = 0; k < record.size(); ++k) {
    const char c = record[k];
    if (c == '"') {
      // A doubled quote closes and opens again, and means one quote.
      if (!quoted && k > 0 && record[k - 1] == '"') *field += '"';
      quoted = !quoted;
    } else if (quoted || (c != separator && c != '\r' && c != '\n')) {
      *field += c;
    } else if (c == separator) {
      field = &begin_field(fields, count);
    }
  }
  return count;
}

}  // namespace

bool CsvReader::next(std::vector<std::string>& fields) {
  // Reads lines until one ends outside quotes.
  std::string text;
  std::string line;
  bool quoted = false;
  while (std::getline(stream_, line)) {
    const bool is_whole = !stream_.eof();
    const auto quotes = std::count(line.begin(), line.end(), '"');
    quoted = quoted != (quotes % 2 == 1);
    if (text.empty()) {
      text.swap(line);
    } else {
      text += line;
    }
    if (is_whole) text += '\n';
    if (!is_whole || !quoted) break;
  }
  is_cut_ = !text.empty() && (quoted || text.back() != '\n');
  if (is_cut_ && !quoted) rest_.swap(text);
  if (text.empty() || is_cut_) return false;
  take(text, fields);
  size_ += text.size();
  text_.swap(text);
  return true;
}

bool CsvReader::last(std::vector<std::string>& fields) {
  if (rest_.empty()) return false;
  take(rest_ + '\n', fields);
  rest_.clear();
  return true;
}

void CsvReader::take(const std::string& record, std::vector<std::string>& fields) {
  const bool has_quotes = record.find('"') != std::string::npos;
  record_.resize(has_quotes ? split_quoted(record, separator_, record_)
                            : split(record, separator_, record_));
  record_.swap(fields);
}

std::vector<std::string> column_of(std::istream& table, const std::string& name) {
  CsvReader reader(table);
  std::vector<std::string> fields;
  if (!reader.next(fields)) return {};
  const auto found = std::find(fields.begin(), fields.end(), name);
  if (found == fields.end()) return {};
  const auto column = static_cast<std::size_t>(found - fields.begin());
  std::vector<std::string> values;
  while (reader.next(fields)) values.push_back(column < fields.size() ? fields[column] : "");
  return values;
}

}  // namespace wscvt
