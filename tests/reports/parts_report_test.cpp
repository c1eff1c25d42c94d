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
#include <utility>
#include <vector>

#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/html_document.h"

namespace wscvt {
namespace {

using test::holds;

/// A box 3 x 2 x 1 as three boxes that are `larger` on each outer side along y and z.
PartsResult three_boxes(double larger) {
  PartsResult result;
  result.grain = test::box(3.0, 2.0, 1.0);
  for (const double x : {-1.0, 0.0, 1.0}) {
    result.parts.push_back(test::moved(test::box(1.0, 2.0 + 2.0 * larger, 1.0 + 2.0 * larger), 1.0,
                                       Vector3(x, 0.0, 0.0)));
  }
  result.measures = measure_parts(result.parts, result.grain);
  result.scan = describe_shape(result.grain, Execution(1));
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
  const std::string page = parts_html(result, {"a folder/a & b.ply", "2026-11-26"}, Execution(1));
  EXPECT_TRUE(holds(page, "2026-11-26"));
  EXPECT_TRUE(holds(page, "<h1>3 convex parts of a &amp; b.ply</h1>"));
  EXPECT_TRUE(holds(page, "A &lt;warning&gt;."));
  for (const std::string& line : parts_lines(result)) {
    EXPECT_TRUE(holds(page, html_escaped(line))) << line;
  }
  // Each part has a colour of its own.
  std::string numbers;
  for (std::size_t k = 0; k < 3; ++k) {
    numbers += std::string(result.parts[k].triangles.size(), static_cast<char>(k));
  }
  EXPECT_TRUE(holds(page, "\"colours\":\"" + base64(numbers) + "\""));
}

TEST(PartsReportJson, HoldsTheMeasures) {
  const PartsResult result = three_boxes(0.05);
  const auto json = nlohmann::json::parse(parts_json(result, {"box.ply", "2026-11-26"}));
  EXPECT_EQ(json.at("parts"), 3);
  EXPECT_EQ(json.at("faces"), nlohmann::json({12, 12, 12}));
  EXPECT_EQ(json.at("source"), "box.ply");
  EXPECT_EQ(json.at("date"), "2026-11-26");
  EXPECT_NEAR(json.at("excess_volume_percent").get<double>(), 100.0 * (2.1 * 1.1 / 2.0 - 1.0),
              1e-9);
  EXPECT_NEAR(json.at("largest_distance").get<double>(), 0.05 * std::sqrt(2.0), 0.002);
  EXPECT_NEAR(json.at("mass_properties").at("volume").get<double>(), 6.0, 1e-12);
  EXPECT_EQ(json.at("warnings"), nlohmann::json({"A <warning>."}));
}

/// A result whose measures are all different. The equivalent radius is 2.
PartsResult numbered_parts() {
  PartsResult result = three_boxes(0.05);
  result.parts[2] = test::sphere(1);  // 80 faces
  PartsMeasures& m = result.measures;
  m.grain_volume = 32.0 * pi / 3.0;
  m.parts_volume = 1.25 * m.grain_volume;
  m.shared_volume = 0.0625 * m.grain_volume;
  m.rms_distance = 0.125;
  m.largest_distance = 0.5;
  m.largest_gap = 0.75;
  return result;
}

TEST(PartsReportNumbers, StandUnderTheirNames) {
  const PartsResult result = numbered_parts();
  const std::vector<std::string> lines = {
      "Convex parts: 3, 12 to 80 faces each",
      "Distance from the parts to the grain: rms 0.125 (6.25 % of the equivalent radius), largest "
      "0.5 (25 % of the equivalent radius)",
      "Points of the grain outside of the parts: at most 0.75 (37.5 % of the equivalent radius)",
      "Volume of the parts beyond the grain's: 25 %, and 6.25 % inside several parts"};
  EXPECT_EQ(parts_lines(result), lines);
  const auto json = nlohmann::json::parse(parts_json(result, {"grain.ply", ""}));
  EXPECT_EQ(json.at("faces"), nlohmann::json({12, 12, 80}));
  const std::pair<const char*, double> expected[] = {
      {"rms_distance", 0.125},
      {"rms_distance_percent", 6.25},
      {"largest_distance", 0.5},
      {"largest_distance_percent", 25.0},
      {"largest_gap", 0.75},
      {"largest_gap_percent", 37.5},
      {"excess_volume_percent", 25.0},
      {"parts_volume", result.measures.parts_volume},
      {"shared_volume", result.measures.shared_volume}};
  for (const auto& [name, value] : expected) {
    EXPECT_NEAR(json.at(name).get<double>(), value, 1e-12 * value) << name;
  }
  const std::string page = parts_html(result, {}, Execution(1));
  const auto mass = mass_rows({{"grain", mass_properties(result.scan)}});
  EXPECT_EQ(test::table_named(page, mass[0][0]), mass);

  PartsResult exact = result;
  exact.measures.parts_volume = (1.0 - 3e-15) * exact.measures.grain_volume;
  EXPECT_TRUE(holds(parts_lines(exact)[3], "grain's: exact, and"));

  PartsResult one = result;
  one.parts.resize(1);
  EXPECT_EQ(parts_lines(one)[0], "Convex parts: 1, 12 faces");
  EXPECT_TRUE(holds(parts_html(one, {}, Execution(1)), "<h1>1 convex part<"));
}

class PartsTable : public test::FileFolder {};

TEST_F(PartsTable, TakesARowPerReport) {
  write_report(path("parts.csv"), three_boxes(0.05), {"one.ply", ""}, Execution(1));
  write_report(path("parts.csv"), three_boxes(0.02), {"two.ply", ""}, Execution(1));
  const auto records = test::csv_records(content("parts.csv"));
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].size(), records[0].size());
  EXPECT_NE(records[1], records[2]);
}

}  // namespace
}  // namespace wscvt
