// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <istream>
#include <limits>
#include <system_error>

#include "wscvt/mesh_files/text_fields.h"

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
  const std::size_t begin = lines_ + 1;
  while (std::getline(stream_, line)) {
    ++lines_;
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
  if (!text.empty()) line_ = begin;
  if (begin == 1 && choice_ != Separator::Comma) {
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    if (names_separator(text)) {
      choice_ = Separator::Comma;
      if (text.size() > 4 && text[4] != '\r' && text[4] != '\n') separator_ = text[4];
      return next(fields);
    }
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
  text_.swap(rest_);
  rest_.clear();
  take(text_ + '\n', fields);
  return true;
}

void CsvReader::take(const std::string& record, std::vector<std::string>& fields) {
  if (choice_ != Separator::Comma) {
    const char found = separator_in(record, ";\t,");
    separator_ = found == '\0' ? ',' : found;
    if (choice_ == Separator::OfFirstRecord) choice_ = Separator::Comma;  // no more to find
  }
  const bool has_quotes = record.find('"') != std::string::npos;
  record_.resize(has_quotes ? split_quoted(record, separator_, record_)
                            : split(record, separator_, record_));
  record_.swap(fields);
}

std::optional<double> number_in_field(std::string_view field, char decimal) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  std::string text(trimmed(field));
  const std::size_t mark = text.find(decimal);
  if (mark != std::string::npos) text[mark] = '.';
  if (text.empty() || text == "NA") return missing;
  const char* const begin = text.data() + (text.front() == '+' ? 1 : 0);
  double value = missing;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (end != text.data() + text.size()) return {};
  return error == std::errc() ? value : std::numeric_limits<double>::infinity();
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
