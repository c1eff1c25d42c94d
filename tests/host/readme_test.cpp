// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of parameters in filter_wscvt/README.md say what the filters take.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "filters.h"

namespace wscvt::filter {
namespace {

/// What the README says of a filter's parameters.
struct Section {
  struct Row {
    std::string value, range;
  };
  std::map<std::string, Row> rows;  ///< by the parameter's name
  std::string text;                 ///< that introduces the table; may name others' parameters
};

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? std::string()
                                    : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

/// The sections that begin with `Of`, in their order.
std::vector<Section> sections() {
  std::ifstream readme(WSCVT_SCRIPTS_DIR "/README.md");
  EXPECT_TRUE(readme.is_open());
  const std::regex name("`([A-Za-z]+)`");
  std::vector<Section> result;
  bool open = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.rfind("Of ", 0) == 0) result.emplace_back();
    open = (open || line.rfind("Of ", 0) == 0) && line.rfind("##", 0) != 0;
    if (!open) continue;
    Section& section = result.back();
    if (line.rfind("| `", 0) != 0) {
      section.text += line;
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(trimmed(cell));
    EXPECT_GE(cells.size(), 4U) << line;
    for (std::sregex_iterator match(cells[0].begin(), cells[0].end(), name), end; match != end;
         ++match) {
      section.rows[(*match)[1]] = {cells[1], cells[2]};
    }
  }
  return result;
}

void expect_described(const FilterParameter& parameter, const Section::Row& row) {
  switch (parameter.kind) {
    case ParameterKind::Integer:
    case ParameterKind::Real:
    case ParameterKind::Choice: {
      EXPECT_EQ(std::strtod(row.value.c_str(), nullptr), parameter.default_value);
      std::smatch range;
      ASSERT_TRUE(std::regex_match(row.range, range, std::regex("(\\S+) to (\\S+)"))) << row.range;
      EXPECT_EQ(std::stod(range[1]), parameter.minimum);
      EXPECT_EQ(std::stod(range[2]), parameter.maximum);
      break;
    }
    case ParameterKind::Flag:
      EXPECT_EQ(row.value, parameter.default_value != 0.0 ? "true" : "false");
      break;
    case ParameterKind::InputFile:
    case ParameterKind::OutputFile: {
      std::string extensions;
      for (const std::string& extension : parameter.extensions) {
        extensions += (extensions.empty() ? "" : ", ") + extension;
      }
      EXPECT_EQ(row.range, extensions);
      [[fallthrough]];
    }
    case ParameterKind::Text:
      EXPECT_EQ(row.value, "");
      break;
  }
}

TEST(Readme, SaysWhatTheFiltersTake) {
  const std::vector<Section> all = sections();
  ASSERT_EQ(all.size(), 3U) << "remesher, creation, descriptors";
  const Section& remesher = all[0];
  for (const Filter& filter : all_filters()) {
    SCOPED_TRACE(filter.name);
    const Section& own = filter.id == FilterId::Create     ? all[1]
                         : filter.id == FilterId::Describe ? all[2]
                                                           : remesher;
    for (const FilterParameter& parameter : filter.parameters) {
      SCOPED_TRACE(parameter.name);
      const auto row = own.rows.find(parameter.name);
      if (row != own.rows.end()) {
        expect_described(parameter, row->second);
      } else {
        EXPECT_NE(own.text.find("`" + parameter.name + "`"), std::string::npos);
        ASSERT_EQ(remesher.rows.count(parameter.name), 1U);
        expect_described(parameter, remesher.rows.at(parameter.name));
      }
    }
    for (const auto& [name, row] : own.rows) {
      bool taken = false;
      for (const FilterParameter& parameter : filter.parameters) taken |= parameter.name == name;
      EXPECT_TRUE(taken) << name << " is described, but there is no such parameter";
    }
  }
}

}  // namespace
}  // namespace wscvt::filter
