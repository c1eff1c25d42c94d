// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/csv_reader.h"

#include <istream>
#include <utility>

namespace wscvt {

bool CsvReader::next(std::vector<std::string>& fields) {
  std::string text;
  std::vector<std::string> record(1);
  bool quoted = false;
  std::streambuf& bytes = *stream_.rdbuf();
  constexpr int end = std::istream::traits_type::eof();
  for (int byte = bytes.sbumpc(); byte != end; byte = bytes.sbumpc()) {
    const char c = static_cast<char>(byte);
    text += c;
    if (c == '"') {
      // A doubled quote closes and opens again, and stands for itself.
      if (!quoted && text.size() > 1 && text[text.size() - 2] == '"') record.back() += '"';
      quoted = !quoted;
    } else if (quoted || (c != ',' && c != '\r' && c != '\n')) {
      record.back() += c;
    } else if (c == ',') {
      record.emplace_back();
    } else if (c == '\n') {
      size_ += text.size();
      text_ = std::move(text);
      fields = std::move(record);
      return true;
    }
  }
  is_cut_ = !text.empty();
  return false;
}

}  // namespace wscvt
