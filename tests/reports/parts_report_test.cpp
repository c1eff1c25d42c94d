// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/parts_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/test_shapes.h"
#include "wscvt/base/readable_text.h"

namespace wscvt {
namespace {

/// A box 3 x 2 x 1 as three boxes that are `larger` on each outer side along y and z.
PartsResult three_boxes(double larger) {
  PartsResult result;
  result.grain = test::box(3.0, 2.0, 1.0);
  for (const double x : {-1.0, 0.0, 1.0}) {
    result.parts.push_back(test::moved(test::box(1.0, 2.0 + 2.0 * larger, 1.0 + 2.0 * larger), 1.0,
                                       Vector3(x, 0.0, 0.0)));
  }
  result.measures = measure_parts(result.parts, result.grain);
  result.original = describe_shape(result.grain, Execution(1));
  result.warnings = {"A <warning>."};
  return result;
}

/// The number at the right end of the page's colour scale.
double end_of_scale(const std::string& page) {
  std::smatch found;
  const std::regex label(">(-?[0-9.e-]+)</text>");
  double most = 0.0;
  for (std::sregex_iterator at(page.begin(), page.end(), label), end; at != end; ++at) {
    most = std::max(most, std::stod((*at)[1].str()));
  }
  return most;
}

TEST(PartsPage, HasTheScaleOfTheOuterSurface) {
  // Faces between the boxes lie up to half the grain's thickness from its surface; the outer ones
  // .05 and, at the edges, .05 times the square root of two.
  const std::string page = parts_html(three_boxes(0.05), {"box.ply", ""}, Execution(1));
  EXPECT_GE(end_of_scale(page), 0.05);
  EXPECT_LE(end_of_scale(page), 0.072);
}

TEST(PartsPage, NamesTheSourceTheWarningAndTheNumbers) {
  const PartsResult result = three_boxes(0.05);
  const std::string page = parts_html(result, {"a folder/a & b.ply", ""}, Execution(1));
  EXPECT_NE(page.find("<h1>3 convex parts of a &amp; b.ply</h1>"), std::string::npos);
  EXPECT_NE(page.find("A &lt;warning&gt;."), std::string::npos);
  for (const std::string& line : parts_lines(result)) {
    EXPECT_NE(page.find(html_escaped(line)), std::string::npos) << line;
  }
}

TEST(PartsReportJson, HoldsTheMeasures) {
  const PartsResult result = three_boxes(0.05);
  const auto json = nlohmann::json::parse(parts_json(result, {"box.ply", "2026-11-26"}));
  EXPECT_EQ(json.at("parts"), 3);
  EXPECT_EQ(json.at("faces"), nlohmann::json({12, 12, 12}));
  EXPECT_EQ(json.at("source"), "box.ply");
  EXPECT_NEAR(json.at("excess_volume_percent").get<double>(), 100.0 * (2.1 * 1.1 / 2.0 - 1.0),
              1e-9);
  EXPECT_NEAR(json.at("largest_distance").get<double>(), 0.05 * std::sqrt(2.0), 0.002);
  EXPECT_NEAR(json.at("mass_properties").at("volume").get<double>(), 6.0, 1e-12);
  EXPECT_EQ(json.at("warnings"), nlohmann::json({"A <warning>."}));
}

class PartsTable : public test::FileFolder {};

TEST_F(PartsTable, TakesARowPerReport) {
  write_report(path("parts.csv"), three_boxes(0.05), {"one.ply", ""}, Execution(1));
  write_report(path("parts.csv"), three_boxes(0.02), {"two.ply", ""}, Execution(1));
  std::ifstream table(path("parts.csv"));
  const auto records = test::csv_records({std::istreambuf_iterator<char>(table), {}});
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].size(), records[0].size());
  EXPECT_NE(records[1], records[2]);
}

}  // namespace
}  // namespace wscvt
