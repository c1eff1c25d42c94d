// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/holds.h"

namespace wscvt::test {

/// The records of a text after RFC 4180.
inline std::vector<std::vector<std::string>> csv_records(const std::string& text) {
  std::vector<std::vector<std::string>> records;
  std::vector<std::string> record(1);
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (quoted) {
      if (c != '"') {
        record.back() += c;
      } else if (k + 1 < text.size() && text[k + 1] == '"') {
        record.back() += text[++k];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      record.emplace_back();
    } else if (c == '\r' && k + 1 < text.size() && text[k + 1] == '\n') {
      ++k;
      records.push_back(std::move(record));
      record.assign(1, "");
    } else {
      record.back() += c;
    }
  }
  EXPECT_EQ(record, std::vector<std::string>(1)) << "the text does not end with a record";
  return records;
}

/// A row of a table: its values by the names of their columns.
using CsvRow = std::map<std::string, std::string>;

/// The rows of a table whose first record names the columns.
inline std::vector<CsvRow> csv_rows(const std::string& text) {
  const auto records = csv_records(text);
  std::vector<CsvRow> rows;
  for (std::size_t k = 1; k < records.size(); ++k) {
    EXPECT_EQ(records[k].size(), records[0].size());
    rows.emplace_back();
    for (std::size_t c = 0; c < records[0].size(); ++c) {
      rows.back()[records[0][c]] = records[k].at(c);
    }
  }
  return rows;
}

/// The same by the values of the column `by`.
inline std::map<std::string, CsvRow> csv_rows(const std::string& text, const std::string& by) {
  std::map<std::string, CsvRow> rows;
  for (const CsvRow& row : csv_rows(text)) rows[row.at(by)] = row;
  return rows;
}

/// Every member that is not in a list by its path; of lists, those of sentences.
inline void flatten(const nlohmann::ordered_json& value, const std::string& path,
                    std::map<std::string, nlohmann::ordered_json>& members) {
  if (value.is_object()) {
    for (const auto& [name, member] : value.items()) {
      flatten(member, path.empty() ? name : path + "." + name, members);
    }
  } else if (!value.is_array() || path == "warnings") {
    members[path] = value;
  }
}

/// Checks that a report's CSV holds what its JSON holds, but for the lists: the same columns and,
/// to the last bit, the same values.
inline void expect_csv_is_flat_json(const std::string& csv, const std::string& json) {
  const auto records = csv_records(csv);
  ASSERT_EQ(records.size(), 2U);
  ASSERT_EQ(records[0].size(), records[1].size());
  std::map<std::string, nlohmann::ordered_json> members;
  flatten(nlohmann::ordered_json::parse(json), "", members);
  EXPECT_EQ(records[0].size(), members.size());
  for (std::size_t k = 0; k < records[0].size(); ++k) {
    const std::string& field = records[1][k];
    SCOPED_TRACE(records[0][k] + " is " + field);
    ASSERT_EQ(members.count(records[0][k]), 1U);
    const nlohmann::ordered_json& value = members[records[0][k]];
    if (value.is_null()) {
      EXPECT_EQ(field, "");
    } else if (value.is_string()) {
      EXPECT_EQ(field, value.get<std::string>());
    } else if (value.is_boolean()) {
      EXPECT_EQ(field, value.get<bool>() ? "true" : "false");
    } else if (value.is_number()) {
      EXPECT_EQ(std::strtod(field.c_str(), nullptr), value.get<double>());
    } else {
      for (const auto& sentence : value) {
        EXPECT_TRUE(holds(field, sentence.get<std::string>()));
      }
    }
  }
}

}  // namespace wscvt::test
