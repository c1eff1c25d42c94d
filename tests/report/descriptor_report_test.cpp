// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/descriptor_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"

namespace wscvt {
namespace {

using test::holds;

GrainMeasures one() {
  return measure_grain({"ball, \"one\"", test::sphere(4)}, std::nullopt, DetailedOptions(),
                       Execution(1));
}

GrainMeasures two() {
  return measure_grain(
      {"ball", test::sphere(4)},
      NamedMesh{"larger", test::transformed(test::sphere(4), 1.1 * Eigen::Matrix3d::Identity())},
      DetailedOptions(), Execution(1));
}

TEST(DescriptorReport, JsonHoldsTheNumbersToTheLastBit) {
  const GrainMeasures alone = one();
  const auto report = nlohmann::json::parse(descriptor_json(alone));
  EXPECT_EQ(report.at("grain"), "ball, \"one\"");
  EXPECT_EQ(report.at("descriptors").at("volume").get<double>(),
            alone.grain.descriptors.basic.volume);
  EXPECT_TRUE(report.at("warnings").empty());
  // Every key is explained once.
  ASSERT_EQ(report.at("descriptor_names").size(), report.at("descriptors").size());
  for (const auto& name : report.at("descriptor_names")) {
    EXPECT_TRUE(report.at("descriptors").contains(name.at("key"))) << name;
  }

  const GrainMeasures pair = two();
  const auto compared = nlohmann::json::parse(descriptor_json(pair));
  EXPECT_EQ(compared.at("reference"), "larger");
  const auto& volume = compared.at("descriptors").at("volume");
  EXPECT_EQ(volume.at("value").get<double>(), pair.grain.descriptors.basic.volume);
  EXPECT_EQ(volume.at("reference").get<double>(), pair.reference->descriptors.basic.volume);
  EXPECT_NEAR(volume.at("error_percent").get<double>(), 100.0 * (std::pow(1.1, -3) - 1.0), 1e-9);
  EXPECT_EQ(compared.at("distances").at("largest_distance").get<double>(), pair.distances->largest);
}

TEST(DescriptorReport, ResolutionIsInTheDocument) {
  GrainMeasures measures = one();
  Resolution resolution;
  resolution.voxel_size = 0.25;
  resolution.voxels_across = 8.5;
  ResolvedValue row;
  row.key = "area";
  row.corrected = 12.0;
  row.low = 11.0;
  row.high = 14.0;
  resolution.rows = {row};
  measures.resolution = resolution;
  const auto report = nlohmann::json::parse(descriptor_json(measures)).at("resolution");
  EXPECT_EQ(report.at("voxel_size"), 0.25);
  EXPECT_EQ(report.at("voxels_across"), 8.5);
  EXPECT_EQ(report.at("area").at("corrected"), 12.0);
  EXPECT_EQ(report.at("area").at("low"), 11.0);
  EXPECT_EQ(report.at("area").at("high"), 14.0);
}

TEST(DescriptorReport, HoldsTheMassProperties) {
  const auto alone = nlohmann::json::parse(descriptor_json(one())).at("mass");
  const GrainMeasures pair = two();
  const auto both = nlohmann::json::parse(descriptor_json(pair)).at("mass");
  EXPECT_EQ(both.at("value"), alone);
  const double larger = both.at("reference").at("principal_moments").at("middle").get<double>();
  EXPECT_NEAR(larger / both.at("value").at("principal_moments").at("middle").get<double>(),
              std::pow(1.1, 5), 1e-9);
  std::string text;
  for (const std::string& line : descriptor_lines(pair)) text += line + "\n";
  EXPECT_TRUE(holds(text, "principal moments"));
}

TEST(DescriptorReport, CsvIsTheJsonWithoutItsLists) {
  for (const GrainMeasures& measures : {one(), two()}) {
    test::expect_csv_is_flat_json(descriptor_csv(measures), descriptor_json(measures));
  }
}

TEST(DescriptorReport, TheSummaryIsShortAndHasLinesOfTheWholeText) {
  for (const GrainMeasures& measures : {one(), two()}) {
    const std::vector<std::string> lines = summary_lines(measures);
    EXPECT_LE(lines.size(), 11U);  // with the seconds 12
    std::string all;
    for (const std::string& line : descriptor_lines(measures)) {
      all += std::regex_replace(line, std::regex(" +"), " ") + "\n";
    }
    std::size_t rows = 0;
    for (const std::string& line : lines) {
      EXPECT_LE(line.size(), 80U) << line;
      if (line.rfind("Distance ", 0) == 0) continue;  // the numbers are tested below
      const std::string row = std::regex_replace(line, std::regex(" +"), " ") + "\n";
      EXPECT_TRUE(holds(all, row)) << line;
      ++rows;
    }
    EXPECT_EQ(rows, measures.reference ? 10U : 9U);
  }
  const GrainMeasures pair = two();
  const std::string last = summary_lines(pair).back();
  const double radius = pair.reference->checked.report.equivalent_radius;
  const auto percent = [&](double d) { return format_number(100.0 * d / radius, 3) + " %"; };
  EXPECT_TRUE(holds(last, "rms " + percent(pair.distances->root_mean_square)));
  EXPECT_TRUE(holds(last, "largest " + percent(pair.distances->largest)));
}

TEST(DescriptorReport, TextHasARowForEveryDescriptorAndDistance) {
  const GrainMeasures pair = two();
  std::string text;
  for (const std::string& line : descriptor_lines(pair)) text += line + "\n";
  for (const DescriptorValue& row : list_descriptors(pair.grain.descriptors)) {
    // The larger grain has a longer cut-off: rows of heights name neither.
    const std::size_t cutoff = row.label.find(" (cut-off ");
    const std::string label = cutoff == std::string::npos
                                  ? row.label
                                  : row.label.substr(0, cutoff) + " (each at its cut-off)";
    const std::string unit = row.unit.empty() ? "" : ", " + row.unit;
    EXPECT_TRUE(holds(text, "  " + label + unit + " ")) << label;
  }
  for (const DistanceRow& row : list_distances(pair)) {
    EXPECT_TRUE(holds(text, "  " + row.label + " ")) << row.label;
  }
  EXPECT_TRUE(distance_lines(one()).empty());
}

TEST(DescriptorReport, DistancesAreEachTheirOwnAndInPercentOfTheReferencesRadius) {
  GrainMeasures measures = two();
  MeshDistances distances;
  distances.largest = 0.7;
  distances.root_mean_square = 0.5;
  distances.to_reference.maximum = 0.6;
  distances.to_reference.root_mean_square = 0.4;
  distances.to_reference.mean = 0.3;
  distances.from_reference.maximum = 0.71;
  distances.from_reference.root_mean_square = 0.51;
  distances.from_reference.mean = 0.31;
  measures.distances = distances;
  std::vector<std::pair<std::string, double>> rows;
  for (const DistanceRow& row : list_distances(measures)) rows.emplace_back(row.key, row.value);
  const std::vector<std::pair<std::string, double>> expected = {
      {"largest_distance", 0.7},  {"largest_to_reference", 0.6}, {"largest_from_reference", 0.71},
      {"rms_distance", 0.5},      {"rms_to_reference", 0.4},     {"rms_from_reference", 0.51},
      {"mean_to_reference", 0.3}, {"mean_from_reference", 0.31}};
  EXPECT_EQ(rows, expected);
  measures.reference->checked.report.equivalent_radius = 2.0;
  const std::string line = distance_lines(measures).at(1);
  EXPECT_EQ(line.substr(line.find_last_of(' ') + 1), "35") << line;
}

}  // namespace
}  // namespace wscvt
