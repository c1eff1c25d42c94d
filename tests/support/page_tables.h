// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace wscvt::test {

using Rows = std::vector<std::vector<std::string>>;

/// A text of a page as it is read.
inline std::string unescaped(std::string text) {
  for (const auto& [entity, sign] : {std::pair("&lt;", "<"), std::pair("&gt;", ">"),
                                     std::pair("&quot;", "\""), std::pair("&amp;", "&")}) {
    const std::string from = entity;
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + 1)) {
      text.replace(at, from.size(), sign);
    }
  }
  return text;
}

/// What stands between each pair of `begin` and `end`.
inline std::vector<std::string> between(const std::string& text, const std::string& begin,
                                        const std::string& end) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    found.push_back(text.substr(at, text.find(end, at) - at));
  }
  return found;
}

/// All tables of a page, row by row.
inline std::vector<Rows> tables_of(const std::string& page) {
  std::vector<Rows> tables;
  for (const std::string& table : between(page, "<table", "</table>")) {
    Rows rows;
    for (const std::string& row : between(table, "<tr>", "</tr>")) {
      std::vector<std::string> cells;
      for (const std::string cell : {"th", "td"}) {
        for (const std::string& text : between(row, "<" + cell + ">", "</" + cell + ">")) {
          cells.push_back(unescaped(text));
        }
      }
      rows.push_back(std::move(cells));
    }
    tables.push_back(std::move(rows));
  }
  return tables;
}

/// The n-th of the tables whose first cell is this; empty if there is none.
inline Rows table_named(const std::string& page, const std::string& first_cell, std::size_t n = 0) {
  for (const Rows& rows : tables_of(page)) {
    if (rows.empty() || rows[0].empty() || rows[0][0] != first_cell) continue;
    if (n-- == 0) return rows;
  }
  return {};
}

/// Lines of a log whose columns are two spaces or more apart.
inline Rows cells_of_lines(const std::vector<std::string>& lines) {
  Rows rows;
  for (const std::string& line : lines) {
    std::vector<std::string> cells;
    for (std::size_t at = line.find_first_not_of(' '); at != std::string::npos;) {
      const std::size_t end = line.find("  ", at);
      cells.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(' ', end);
    }
    rows.push_back(std::move(cells));
  }
  return rows;
}

/// How often a part stands in a text.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

}  // namespace wscvt::test
