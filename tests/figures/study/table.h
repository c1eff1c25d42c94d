// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"

/// What the study measures, as rows of cells; the first row holds the names of the columns.
namespace wscvt::study {

using Table = std::vector<std::vector<std::string>>;

inline void write_csv(const std::string& path, const Table& table) {
  std::string text;
  for (const auto& row : table) text += csv_record(row);
  write_file(path, text);
}

/// The table with a heading, for study.txt.
inline std::string as_text(const std::string& heading, const Table& table) {
  std::string text = heading + "\n\n";
  for (const std::string& line : aligned_lines(table)) text += "  " + line + "\n";
  return text + "\n";
}

}  // namespace wscvt::study
