// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/sample_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/plain_statistics.h"
#include "support/test_shapes.h"
#include "toolbox/report/sample_report.h"
#include "toolbox/report/sample_table.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/report/report.h"

namespace wscvt {
namespace {

using test::holds;

class SampleSummaryOfAFile : public testing::Test {
 protected:
  SampleSummaryOfAFile()
      : path_(testing::TempDir() + "wscvt_sample_" +
              testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv") {}
  ~SampleSummaryOfAFile() override { std::remove(path_.c_str()); }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }

  std::string path_;
};

/// The page of a batch whose grains were not described.
std::string page_of(const SampleSummary& batch) {
  SampleReport report;
  report.samples.emplace_back();
  report.samples.front().batch = batch;
  return sample_html(report, Execution(1));
}

RemeshResult grain_of(double radius, const std::vector<Sentence>& warnings = {}) {
  RemeshResult result;
  result.input.equivalent_radius = radius;
  result.scan.inertia_semi_axes = Vector3(1.0, 2.0, 4.0);
  result.warnings = warnings;
  return result;
}

TEST(SampleTable, RowsHaveTheColumnsOfTheHeader) {
  const std::string table = sample_header() +
                            sample_row("a.ply", grain_of(2.0, {"Odd.", "Odder."})) +
                            failed_row("b, c.ply", "It is \"broken\".");
  const auto records = test::csv_records(table);
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].size(), records[0].size());
  EXPECT_EQ(records[2].size(), records[0].size());
  EXPECT_EQ(records[1][0], "a.ply");
  EXPECT_EQ(records[1][1], "done");
  EXPECT_EQ(records[1].back(), "Odd. | Odder.");
  EXPECT_EQ(records[2][0], "b, c.ply");
  EXPECT_EQ(records[2][1], "failed");
  EXPECT_EQ(records[2][2], "It is \"broken\".");
  EXPECT_EQ(records[2].back(), "");
}

TEST(SampleSummary, OfATableThatTheSystemRefusesToReadIsNotMade) {
  // A file of Linux that can be opened, and whose first byte cannot be read.
  EXPECT_THROW(summarise_table("/proc/self/mem"), MachineRefused);
}

TEST_F(SampleSummaryOfAFile, CountsGrainsAndTheirNumbers) {
  std::string table = sample_header();
  for (const double radius : {4.0, 1.0, 3.0, 2.0}) {
    table += sample_row("grain", grain_of(radius));
  }
  table += sample_row("warned", grain_of(10.0, {"Odd."})) + failed_row("bad", "Broken.");
  write(table);
  const SampleSummary summary = summarise_table(path_);
  EXPECT_EQ(summary.grains, 6U);
  EXPECT_EQ(summary.failed, 1U);
  EXPECT_EQ(summary.with_warnings, 1U);
  ASSERT_EQ(summary.failures.size(), 1U);
  EXPECT_EQ(summary.failures[0].grain, "bad");
  EXPECT_EQ(summary.failures[0].message, "Broken.");
  const auto json = nlohmann::ordered_json::parse(summary_json(summary));
  const auto& radius = json.at("distributions").at("equivalent_radius");
  EXPECT_EQ(radius.at("count"), 5);
  EXPECT_EQ(radius.at("mean"), 4.0);
  EXPECT_EQ(radius.at("minimum"), 1.0);
  EXPECT_EQ(radius.at("median"), 3.0);
  EXPECT_EQ(radius.at("maximum"), 10.0);
  // The squares add up to 50, over 5 - 1.
  EXPECT_NEAR(radius.at("standard_deviation").get<double>(), std::sqrt(12.5), 1e-12);
  EXPECT_NEAR(json.at("distributions").at("elongation").at("mean").get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(json.at("distributions").at("flatness").at("mean").get<double>(), 0.5, 1e-12);
  EXPECT_TRUE(holds(page_of(summary), "Broken."));
  EXPECT_EQ(summary_lines(summary).front(),
            "6 grains: 5 remeshed, 1 of them with warnings, 1 failed");
  EXPECT_EQ(summary_lines(summary)[1], "Warnings: warned");
  EXPECT_EQ(json.at("grains_with_warnings"), nlohmann::ordered_json::array({"warned"}));
  EXPECT_EQ(test::table_named(page_of(summary), "grain", 1),
            (test::Rows{{"grain", "warnings"}, {"warned", "Odd."}}));
  for (const std::string& line : summary_lines(summary)) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_EQ(summary_lines(summary).size(), 9U);  // with the folder and the seconds 11
}

TEST_F(SampleSummaryOfAFile, NamesTheGrainsWithWarningsThatFitOnALine) {
  std::string table = sample_header();
  for (int k = 0; k < 250; ++k) {
    table += sample_row("grain_" + std::to_string(k), grain_of(1.0, {"Odd."}));
  }
  write(table);
  const std::string line = summary_lines(summarise_table(path_)).at(1);
  EXPECT_LE(line.size(), 80U);
  EXPECT_EQ(line.rfind("Warnings: grain_0, grain_1, ", 0), 0U) << line;
  // Those that are named and those that are counted are all.
  const auto named = std::count(line.begin(), line.end(), ',') + 1;
  EXPECT_TRUE(holds(line, " and " + std::to_string(250 - named) + " more"));
}

TEST_F(SampleSummaryOfAFile, EveryDistributionIsOfItsOwnColumn) {
  RemeshResult result;
  result.input.equivalent_radius = 2.0;
  result.scan.volume = 3.0;
  result.scan.area = 5.0;
  result.scan.aspect_ratio = 0.25;
  result.scan.sphericity = 0.875;
  result.scan.inertia_semi_axes = Vector3(1.0, 1.25, 4.0);
  result.remesh = result.scan;
  result.remesh.volume = 3.3;
  result.remesh.area = 6.0;
  result.remesh.sphericity = 0.4375;
  result.rms_distance = 0.03;
  result.scan_quality.edge_ratio.mean = 9.0;
  result.scan_quality.smallest_angle = 9.5;
  result.quality.edge_ratio = {1.5, 2.5, 3.5, 4.5};
  result.quality.smallest_angle = 33.0;
  result.quality.mean_smallest_angle = 44.0;
  write(sample_header() + sample_row("a", result));
  const auto all =
      nlohmann::ordered_json::parse(summary_json(summarise_table(path_))).at("distributions");
  const std::map<std::string, double> expected = {
      {"equivalent_radius", 2.0}, {"volume", 3.0},      {"aspect_ratio", 0.25},
      {"elongation", 0.3125},     {"flatness", 0.8},    {"sphericity", 0.875},
      {"volume_error", 10.0},     {"area_error", 20.0}, {"sphericity_error", -50.0},
      {"rms_distance", 1.5},      {"edge_ratio", 1.5},  {"smallest_angle", 33.0}};
  for (const auto& [key, value] : expected) {
    EXPECT_NEAR(all.at(key).at("median").get<double>(), value, 1e-12) << key;
  }
  // And each of its numbers in its own place: 0, 1, ..., 9 and 100.
  std::string table = sample_header();
  for (const double radius : {100.0, 9.0, 1.0, 8.0, 2.0, 7.0, 3.0, 6.0, 4.0, 5.0, 0.5}) {
    table += sample_row("a", grain_of(radius));
  }
  write(table);
  const SampleSummary summary = summarise_table(path_);
  const auto radius = nlohmann::ordered_json::parse(summary_json(summary))
                          .at("distributions")
                          .at("equivalent_radius");
  EXPECT_EQ(radius.at("minimum"), 0.5);
  EXPECT_NEAR(radius.at("percent_10").get<double>(), 0.8, 1e-14);  // 0.6 behind the first
  EXPECT_EQ(radius.at("median"), 5.0);
  EXPECT_NEAR(radius.at("percent_90").get<double>(), 45.4, 1e-12);
  EXPECT_EQ(radius.at("maximum"), 100.0);
  EXPECT_GT(radius.at("standard_deviation"), radius.at("mean"));
  bool found = false;
  for (const std::string& line : summary_lines(summary)) {
    if (line.rfind("equivalent radius", 0) != 0) continue;
    std::istringstream cells(line.substr(line.find("length") + 6));
    double mean = 0.0;
    std::vector<double> rest;
    cells >> mean;
    for (double cell = 0.0; cells >> cell;) rest.push_back(cell);
    EXPECT_EQ(rest, (std::vector<double>{0.8, 5.0, 45.4})) << line;
    EXPECT_NEAR(mean, 145.5 / 11.0, 0.05);  // three digits
    found = true;
  }
  EXPECT_TRUE(found);
  // An error of nothing but rounding is no number.
  const std::vector<std::string> lines = summary_lines(summary);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.rfind("error of the volume", 0) == 0 && line.find("exact") != std::string::npos;
  }));
}

TEST_F(SampleSummaryOfAFile, NamesOnlyTheFirstOfManyFailures) {
  std::string table = sample_header();
  for (std::size_t k = 0; k < most_failures_named + 7; ++k) table += failed_row("bad", "Broken.");
  write(table);
  const SampleSummary summary = summarise_table(path_);
  EXPECT_EQ(summary.failed, most_failures_named + 7);
  EXPECT_EQ(summary.failures.size(), most_failures_named);
  EXPECT_TRUE(holds(page_of(summary), "And 7 more"));
}

TEST_F(SampleSummaryOfAFile, CountsTheWarningsThatItDoesNotName) {
  std::string table = sample_header();
  for (std::size_t k = 0; k < most_failures_named + 7; ++k) {
    table += sample_row("odd", grain_of(1.0, {"Odd."}));
  }
  write(table);
  EXPECT_TRUE(holds(page_of(summarise_table(path_)), "And 7 more"));
}

TEST_F(SampleSummaryOfAFile, OfEquallyFarRemeshesTheFirstIsFirst) {
  std::string table = sample_header();
  for (const char* name : {"c", "a", "b"}) {
    RemeshResult result = grain_of(1.0);
    result.rms_distance = 0.01;
    table += sample_row(name, result);
  }
  write(table);
  std::string order;
  for (const GrainDistance& one : summarise_table(path_).farthest) order += one.grain;
  EXPECT_EQ(order, "cab");
}

TEST_F(SampleSummaryOfAFile, HasTheStatesOfTheLabels) {
  write(sample_header() + sample_row("a", grain_of(1.0)));
  SampleSummary summary = summarise_table(path_);
  EXPECT_FALSE(holds(summary_json(summary), "\"labels\""));
  summary.labels = {{"all", 7}, {"written", 5}, {"at the border", 2}};
  const auto json = nlohmann::ordered_json::parse(summary_json(summary));
  EXPECT_EQ(json.at("labels").at("at the border"), 2);
  EXPECT_TRUE(holds(page_of(summary), "<p>7 labels: 5 written, 2 at the border.</p>"));
}

TEST(CensusLine, TellsEachStateThatThereIs) {
  const CensusStates all = {{"all", 30},      {"written", 3}, {"pieces", 2}, {"at the border", 4},
                            {"too small", 5}, {"open", 6},    {"failed", 7}, {"pores", 1}};
  EXPECT_EQ(census_line(all, "bodies"),
            "30 bodies: 3 written (2 in pieces), 4 at the border, 5 too small, 6 open and only "
            "listed, 7 failed, 1 pore in them");
  EXPECT_EQ(census_line({{"all", 1}, {"taken", 1}, {"pores", 2}}, "bodies"),
            "1 body: 1 taken, 2 pores in them");
  EXPECT_EQ(census_line({{"all", 8}}, "labels"), "8 labels: 0 written");
}

TEST(SampleTable, KnowsTheErrorOfAGrainAndOfALabel) {
  EXPECT_EQ(failure_in("a.ply,failed,\"It, broke.\",7\r\n"), "It, broke.");
  EXPECT_EQ(failure_in("ct.nrrd,5,800,failed,It broke.,\r\n"), "It broke.");
  EXPECT_EQ(failure_in("a.ply,done,,7\r\n"), "");
}

TEST_F(SampleSummaryOfAFile, ThePageHasTheOptionsOfAllGrains) {
  RemeshResult first = grain_of(1.0);
  first.options.node_count = 321;
  std::get<OnScanOptions>(first.options.method).edge_ratio = 1.25;
  RemeshResult second = first;
  second.options.node_count = 322;
  write(sample_header() + failed_row("bad", "Broken.") + sample_row("a", first) +
        sample_row("b", first));
  std::string page = page_of(summarise_table(path_));
  EXPECT_TRUE(holds(page, ", nodes 321,"));
  EXPECT_TRUE(holds(page, ", edge-ratio 1.25,"));
  write(sample_header() + sample_row("a", first) + sample_row("b", second));
  page = page_of(summarise_table(path_));
  EXPECT_TRUE(holds(page, ", nodes several,"));
  EXPECT_TRUE(holds(page, ", edge-ratio 1.25,"));
}

TEST_F(SampleSummaryOfAFile, ThePageShowsTheFarthestRemeshesFirst) {
  std::string table = sample_header();
  for (int k = 0; k < 150; ++k) {
    RemeshResult result = grain_of(1.0);
    result.rms_distance = 0.001 * ((k * 37) % 150 + 1);
    table += sample_row("folder/grain" + std::to_string(k) + ".ply", result);
  }
  table += failed_row("folder/bad.ply", "Broken.");
  write(table);
  SampleSummary summary = summarise_table(path_);
  EXPECT_FALSE(holds(page_of(summary), "farthest")) << "no file is known";
  ASSERT_EQ(summary.farthest.size(), most_grains_shown);
  const std::string mesh = path_ + ".ply";
  write_mesh(test::tetrahedron(2.0), mesh);
  for (std::size_t k = 0; k < most_grains_shown; ++k) {
    EXPECT_NEAR(summary.farthest[k].percent, 0.1 * (150.0 - static_cast<double>(k)), 1e-12);
    summary.farthest[k].file = k == 1 ? path_ + ".none" : mesh;  // one has no file
  }
  const std::string page = page_of(summary);
  std::remove(mesh.c_str());
  EXPECT_TRUE(holds(page, "The 13 of 150 remeshes that are farthest"));
  const auto name = [&](std::size_t k) {
    return summary.farthest[k].grain.substr(7, summary.farthest[k].grain.size() - 11) + "<br>";
  };
  const std::size_t first = page.find(name(0) + "15 %");
  ASSERT_NE(first, std::string::npos);
  EXPECT_FALSE(holds(page, name(1)));
  EXPECT_LT(first, page.find(name(2)));
}

TEST_F(SampleSummaryOfAFile, CountsTheKindsOfWarnings) {
  std::string table = sample_header();
  for (int k = 0; k < 30; ++k) {
    const std::string number = std::to_string(k);
    const std::string name = "g" + number;
    table += sample_row(
        name,
        k == 7   ? grain_of(1.0)
        : k < 20 ? grain_of(1.0, {"It is not accurate: rms distance 1." + number + " %. Use more."})
                 : grain_of(1.0, {number + ".5 of \"" + name + "\" intersect " + number + ". Odd.",
                                  "It is not accurate: rms distance 2 %.", "It is not accurate."}));
  }
  write(table);
  const SampleSummary summary = summarise_table(path_);
  const std::string page = page_of(summary);
  EXPECT_EQ(test::table_named(page, "warning"),
            (test::Rows{{"warning", "grains", "first"},
                        {"It is not accurate", "29", "g0"},
                        {"N of \"...\" intersect N", "10", "g20"}}));
  const auto kinds = nlohmann::ordered_json::parse(summary_json(summary)).at("warning_kinds");
  ASSERT_EQ(kinds.size(), 2U);
  EXPECT_EQ(kinds[1].at("grains"), 10);
  EXPECT_EQ(kinds[1].at("first"), "g20");
  // The grains themselves are collapsed.
  EXPECT_TRUE(holds(page, "<details><summary>29 grains, each with its warnings</summary>"));
  EXPECT_EQ(test::table_named(page, "grain").size(), 30U);
}

TEST_F(SampleSummaryOfAFile, RoundingHasNoHistogram) {
  std::string table = sample_header();
  double radius = 0.0;
  for (const double volume : {3.0, 3.0 + 1e-15, 3.0 - 2e-15}) {
    RemeshResult result = grain_of(radius += 1.0);
    result.scan.volume = 3.0;
    result.remesh.volume = volume;
    table += sample_row("grain", result);
  }
  write(table);
  const std::string page = page_of(summarise_table(path_));
  EXPECT_FALSE(holds(page, "Error of the volume"));
  EXPECT_TRUE(holds(page, "Equivalent radius of 3 grains"));
}

TEST_F(SampleSummaryOfAFile, RefusesWhatIsNoTableOfASample) {
  for (const std::string& text : {std::string(), std::string("a,b\r\n1,2\r\n"),
                                  sample_header() + "a,done\r\n", sample_header() + "a,done"}) {
    write(text);
    EXPECT_ERROR(summarise_table(path_), InvalidInput);
  }
  std::remove(path_.c_str());
  EXPECT_ERROR(summarise_table(path_), InputOutput);
}

TEST_F(SampleSummaryOfAFile, EveryNumberOfThePageIsThatOfItsDefinition) {
  std::string table = sample_header();
  Eigen::VectorXd radii(13);
  for (Eigen::Index k = 0; k < 13; ++k) {
    radii[k] = 1.0 + 0.37 * std::pow(static_cast<double>((k * 5) % 13), 2);
    RemeshResult result = grain_of(radii[k]);
    result.scan.volume = 3.0 * radii[k];
    table += sample_row("grain" + std::to_string(k), result);
  }
  table += failed_row("bad <one>", "Broken & gone.");
  write(table);
  const SampleSummary summary = summarise_table(path_);
  const std::string page = page_of(summary);
  EXPECT_TRUE(holds(page, "<h1>A sample of 14 grains</h1>"));
  EXPECT_TRUE(holds(page, "<p>14 grains: 13 remeshed, 0 of them with warnings, 1 failed.</p>"));
  EXPECT_EQ(test::table_named(page, "grain"),
            (test::Rows{{"grain", "error"}, {"bad <one>", "Broken & gone."}}));
  const test::Rows rows = test::table_named(page, "Quantity");
  ASSERT_GE(rows.size(), 3U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"Quantity", "mean", "std. dev. (n - 1)", "smallest",
                                               "10 %", "50 %", "90 %", "largest"}));
  const auto expect = [&](std::size_t row, const std::string& name, const Eigen::VectorXd& values) {
    const test::PlainStatistics plain(values);
    std::vector<std::string> cells = {name};
    for (const double value :
         {plain.mean(), plain.deviation(), plain.grains().front().first, plain.quantile(0.1),
          plain.quantile(0.5), plain.quantile(0.9), plain.grains().back().first}) {
      cells.push_back(format_number(value, 4));
    }
    EXPECT_EQ(rows[row], cells);
  };
  expect(1, "equivalent radius, length", radii);
  expect(2, "volume, length^3", 3.0 * radii);
  EXPECT_TRUE(holds(page, " of 13 grains, half of them below " +
                              format_number(test::PlainStatistics(radii).quantile(0.5), 4) + "."));
  const auto json = nlohmann::ordered_json::parse(summary_json(summary));
  EXPECT_EQ(json.at("grains"), 14);
  EXPECT_EQ(json.at("remeshed"), 13);
  EXPECT_EQ(json.at("failed"), 1);
  EXPECT_EQ(json.at("failures"),
            nlohmann::ordered_json({{{"grain", "bad <one>"}, {"error", "Broken & gone."}}}));
}

TEST(HistogramOf, CountsEveryValueInItsBin) {
  std::vector<double> values;
  for (int k = 0; k < 100; ++k) values.push_back(static_cast<double>(k));
  const Histogram histogram = histogram_of(values);
  EXPECT_EQ(histogram.lower, 0.0);
  EXPECT_EQ(histogram.upper, 99.0);
  EXPECT_EQ(histogram.counts, std::vector<std::size_t>(10, 10));  // the square root of 100
  EXPECT_EQ(histogram_of({1.0, 2.0, 8.0}).counts.size(), 8U);
  EXPECT_EQ(histogram_of(std::vector<double>(5000, 1.0)).counts.size(), 60U);
  const Histogram equal = histogram_of({2.0, 2.0});
  EXPECT_LT(equal.lower, 2.0);
  EXPECT_GT(equal.upper, 2.0);
}

}  // namespace
}  // namespace wscvt
