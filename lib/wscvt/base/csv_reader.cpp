// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/csv_reader.h"

#include <algorithm>
#include <istream>
#include <string_view>
#include <utility>

namespace wscvt {

namespace {

/// The next of a record's fields, whose text of the last record is kept as room.
std::string& begin_field(std::vector<std::string>& fields, std::size_t& count) {
  if (count == fields.size()) fields.emplace_back();
  fields[count].clear();
  return fields[count++];
}

/// Takes a record without quotes apart; returns the number of its fields.
std::size_t split(std::string_view record, std::vector<std::string>& fields) {
  std::size_t count = 0;
  record.remove_suffix(1);
  while (true) {
    const std::size_t comma = record.find(',');
    const std::string_view text = record.substr(0, comma);
    std::string& field = begin_field(fields, count);
    field = text;
    field.erase(std::remove(field.begin(), field.end(), '\r'), field.end());
    if (comma == std::string_view::npos) return count;
    record.remove_prefix(comma + 1);
  }
}

/// Takes a record with quotes apart.
std::size_t split_quoted(std::string_view record, std::vector<std::string>& fields) {
  std::size_t count = 0;
  std::string* field = &begin_field(fields, count);
  bool quoted = false;
  for (std::size_t k = 0; k < record.size(); ++k) {
    const char c = record[k];
    if (c == '"') {
      // A doubled quote closes and opens again, and stands for itself.
      if (!quoted && k > 0 && record[k - 1] == '"') *field += '"';
      quoted = !quoted;
    } else if (quoted || (c != ',' && c != '\r' && c != '\n')) {
      *field += c;
    } else if (c == ',') {
      field = &begin_field(fields, count);
    }
  }
  return count;
}

}  // namespace

bool CsvReader::next(std::vector<std::string>& fields) {
  // Lines up to one that ends outside of quotes.
  std::string text;
  std::string line;
  bool has_quotes = false;
  bool quoted = false;
  while (std::getline(stream_, line)) {
    const bool is_whole = !stream_.eof();
    const auto quotes = std::count(line.begin(), line.end(), '"');
    has_quotes = has_quotes || quotes > 0;
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
  if (text.empty() || is_cut_) return false;
  const std::size_t count = has_quotes ? split_quoted(text, record_) : split(text, record_);
  record_.resize(count);
  record_.swap(fields);
  size_ += text.size();
  text_.swap(text);
  return true;
}

}  // namespace wscvt
