// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/sample_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/plain_statistics.h"
#include "support/test_shapes.h"
#include "toolbox/report/sample_table.h"
#include "toolbox/report/shape_table.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Document = nlohmann::ordered_json;
using test::holds;

/// Grains with sizes 1, 2, ..., whose names could end an element of a page. Those of the other
/// sample are larger.
SampleReport report_of(Eigen::Index grains, bool with_other) {
  SampleReport report;
  report.options.repetitions = 20;
  for (int k = 0; k < (with_other ? 2 : 1); ++k) {
    GrainTable table;
    table.columns = {{"volume", "mm^3"},
                     {"axis_i_box", "mm"},
                     {"axis_s_box", "mm"},
                     {"axis_l_box", "mm"},
                     {"convexity", ""}};
    const Eigen::VectorXd sizes =
        (1.0 + 0.2613 * k) * Eigen::VectorXd::LinSpaced(grains, 1.0, static_cast<double>(grains));
    table.values.resize(grains, 5);
    table.values << sizes.array().cube(), sizes, 0.8 * sizes, (1.5 + k) * sizes,
        1.0 - 0.1 * (sizes.array() * 7.3).sin().abs();
    table.values(1, 4) = std::nan("");
    for (Eigen::Index row = 0; row < grains; ++row) {
      table.grains.push_back("a</script><!--" + std::to_string(row));
      table.files.push_back(std::to_string(row) + ".ply");
    }
    ReportedSample one;
    one.name = k == 0 ? "first" : "second & last";
    one.sample = sample_of(table, report.options);
    one.statistics = measure_sample(one.sample, report.options, Execution(1));
    report.samples.push_back(std::move(one));
  }
  if (with_other) {
    report.comparison = compare_samples(report.samples[0].sample, report.samples[1].sample,
                                        report.options, Execution(1));
  }
  return report;
}

/// The numbers that a page's figures are drawn of.
Document data_of(const std::string& page) {
  const std::string begin = "id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Document::parse(page.substr(from, page.find("</script>", from) - from));
}

/// A number as a table shows it, beside its interval if it has one.
std::string shown(double value, const Estimate& interval) {
  const std::string text = format_number(value, 4);
  if (std::isnan(interval.lower)) return text;
  return text + " (" + format_number(interval.lower, 4) + " to " +
         format_number(interval.upper, 4) + ")";
}

/// 40 grains of 8 to 47 voxels across, whose sphericity only the voxels make depend on the size.
GrainTable scanned_table() {
  constexpr Eigen::Index grains = 40;
  GrainTable table;
  table.columns = {{"scan.volume", "mm^3"},
                   {"scan.axis_i_box", "mm"},
                   {"scan.area", "mm^2"},
                   {"scan.sphericity_wadell", ""},
                   {"resolution.voxel_size", "mm"},
                   {"resolution.voxels_across", ""},
                   {"resolution.area.corrected", ""},
                   {"resolution.sphericity_wadell.corrected", ""},
                   {"nodes", ""}};
  table.values.resize(grains, 9);
  for (Eigen::Index k = 0; k < grains; ++k) {
    const double across = 8.0 + static_cast<double>(k);
    const double true_value = 0.8 + 0.01 * std::sin(5.0 * across);
    const double size = 0.1 * across;
    const double area = 3.0 * size * size;
    table.values.row(k) << size * size * size, size, 0.95 * area, true_value + 1.0 / across, 0.1,
        across, area, true_value, 300.0;
    table.grains.push_back("grain " + std::to_string(k));
  }
  table.values(0, 7) = std::nan("");  // not resolved
  return table;
}

/// What a page calls the columns of these samples.
const std::map<std::string, std::string> in_words = {{"size", "size"},
                                                     {"volume", "volume"},
                                                     {"axis_i_box", "axis I (oriented box)"},
                                                     {"axis_s_box", "axis S (oriented box)"},
                                                     {"axis_l_box", "axis L (oriented box)"},
                                                     {"convexity", "convexity V / V(hull)"},
                                                     {"rms_distance", "rms distance"},
                                                     {"contact_normal_90", "contact normal 90"}};

/// Levels whose numbers are all different: k and 90 % of k * 10 of row r at level l.
DetailLevels six_levels() {
  DetailLevels levels;
  levels.mark_percent = 1.5;
  levels.nodes = {100.0, 200.0, 400.0, 800.0, 1600.0, 3200.0};
  for (const char* name : {"volume", "convexity", "rms_distance", "contact_normal_90"}) {
    DescriptorLevels row;
    row.name = name;
    if (row.name == "contact_normal_90") row.unit = "degrees";
    for (std::size_t l = 0; l < 6; ++l) {
      LevelError error;
      error.count = 7 + l;
      error.median =
          0.5 + static_cast<double>(levels.rows.size()) + 0.0625 * static_cast<double>(l);
      error.percent_90 = 10.0 * error.median;
      row.levels.push_back(error);
    }
    row.nodes_needed = 1000.0 + 100.0 * static_cast<double>(levels.rows.size());
    levels.rows.push_back(row);
  }
  levels.rows[0].levels[5].median = 1e-13;
  levels.rows[1].levels[0].count = 0;
  return levels;
}

TEST(SampleReport, TellsWhichTrendsAreTheVoxels) {
  SampleReport report;
  report.options.repetitions = 0;
  SampleTables tables;
  tables.tables.push_back(scanned_table());
  add_sample(report, "sand", tables, {}, 1.0, Execution(1));
  const ReportedSample& one = report.samples.front();
  ASSERT_EQ(one.trends.size(), 1U);  // lengths and areas grow with the size anyway
  const VoxelTrend& trend = one.trends.front();
  EXPECT_EQ(trend.name, "sphericity_wadell");
  EXPECT_EQ(trend.count, 39U);
  EXPECT_EQ(trend.trusted_count, 33U);  // 15 to 47 voxels
  EXPECT_LT(trend.raw.upper, -0.5);
  EXPECT_LT(std::abs(trend.corrected.value), 0.3);
  EXPECT_LT(std::abs(trend.trusted.value), 0.3);
  // Fifths of eight grains: 8 to 15 voxels, then 16 and more.
  ASSERT_EQ(one.sample.notes.size(), 2U);
  EXPECT_TRUE(holds(one.sample.notes[0], "sphericity_wadell of 1 of 40 grains"));
  EXPECT_EQ(one.sample.notes[1].rfind("8 grains of size 0.8 to 1.5 mm have 11.5 voxels across", 0),
            0U)
      << one.sample.notes[1];
  std::string text;
  for (const std::string& line : sample_lines(report)) {
    // Notes stay whole: who shows them breaks them.
    EXPECT_TRUE(line.size() <= 80U ||
                std::count(one.sample.notes.begin(), one.sample.notes.end(), line) > 0)
        << line;
    text += line + "\n";
  }
  EXPECT_TRUE(holds(text, "correlation with size"));
  const Document json = Document::parse(sample_json(report));
  const Document& told = json["samples"][0]["trends_with_voxels"]["sphericity_wadell"];
  EXPECT_EQ(told["raw"]["value"].get<double>(), trend.raw.value);
  EXPECT_EQ(told["corrected"]["value"].get<double>(), trend.corrected.value);
  EXPECT_EQ(told["trusted"]["value"].get<double>(), trend.trusted.value);
  EXPECT_EQ(told["grains"].get<std::size_t>(), 39U);
  EXPECT_EQ(told["trusted_grains"].get<std::size_t>(), 33U);
  std::map<std::string, std::string> in_csv;
  for (const auto& record : test::csv_records(sample_csv(report))) {
    if (record[1] == trend.name) in_csv[record[4]] = record[5] + " " + record[6] + " " + record[7];
  }
  for (const auto& [name, e] : {std::pair("resolved", trend.raw),
                                {"corrected", trend.corrected},
                                {"trusted", trend.trusted}}) {
    EXPECT_EQ(in_csv.at(std::string("size_correlation_") + name),
              format_exact(e.value) + " " + format_exact(e.lower) + " " + format_exact(e.upper));
  }
  const test::Rows log = test::cells_of_lines(sample_lines(report));
  EXPECT_EQ(std::count(log.begin(), log.end(),
                       std::vector<std::string>{trend.name, "39", format_number(trend.raw.value, 4),
                                                format_number(trend.corrected.value, 4),
                                                format_number(trend.trusted.value, 4)}),
            1);
  const std::string page = sample_html(report, Execution(1));
  const test::Rows trends = test::table_named(page, "correlation with size");
  ASSERT_EQ(trends.size(), 2U);
  EXPECT_EQ(trends[1], (std::vector<std::string>{"sphericity (Wadell)", "39",
                                                 shown(trend.raw.value, trend.raw),
                                                 shown(trend.corrected.value, trend.corrected),
                                                 "33", shown(trend.trusted.value, trend.trusted)}));
  const Document data = data_of(page);
  EXPECT_EQ(data["leastAcross"].get<double>(), 15.0);
  EXPECT_EQ(data["nodesOfFace"].get<double>(), 0.25);  // a node of each 2 by 2 voxels
  EXPECT_EQ(data["samples"][0]["resolved"], Document({"area", "sphericity_wadell"}));
  EXPECT_EQ(data["samples"][0]["across"].size(), 40U);
  EXPECT_EQ(data["samples"][0]["corrected"][0][0].get<double>(), 1.92);
  EXPECT_TRUE(data["samples"][0]["corrected"][1][0].is_null());
  // Remeshes are another matter, and so is a table without voxels.
  EXPECT_TRUE(report_of(40, false).samples.front().trends.empty());
}

// The page's script draws against the voxels of each sample that has them, first or not.
TEST(SampleReport, TellsTheVoxelsOfASecondSample) {
  GrainTable meshes = scanned_table();
  for (GrainColumn& column : meshes.columns) {
    if (column.name.rfind("resolution.", 0) == 0) column.name = "else." + column.name;
  }
  GrainTable other = scanned_table();
  other.values.col(3) = other.values.col(3).reverse().eval();
  const auto page_of = [](const std::vector<GrainTable>& tables) {
    SampleReport report;
    report.options.repetitions = 0;
    for (const GrainTable& table : tables) {
      SampleTables one;
      one.tables.push_back(table);
      add_sample(report, "sample", one, {}, 1.0, Execution(1));
    }
    return sample_html(report, Execution(1));
  };
  const std::string name = "correlation with size";
  const std::string alone = page_of({other});
  const test::Rows expected = test::table_named(alone, name);
  ASSERT_EQ(expected.size(), 2U);
  for (const GrainTable& first : {meshes, scanned_table()}) {
    const bool are_both = first.columns[4].name == "resolution.voxel_size";
    const std::string page = page_of({first, other});
    EXPECT_EQ(test::count_of(page, "id=\"voxels\""), 1U);
    EXPECT_EQ(test::table_named(page, name, are_both ? 1 : 0), expected);
    EXPECT_EQ(test::table_named(page, name, are_both ? 2 : 1), test::Rows());
  }
  EXPECT_FALSE(holds(page_of({meshes, meshes}), "id=\"voxels\""));
}

TEST(SampleReport, TakesTheFinestTableAndEachSamplesOwnDensity) {
  SampleTables levels;
  for (const double nodes : {100.0, 1000.0, 300.0}) {
    levels.tables.push_back(scanned_table());
    levels.tables.back().values.col(8).setConstant(nodes);
    levels.tables.back().values.col(2) *= nodes;  // the areas tell which table it is
  }
  SampleReport report;
  report.options.repetitions = 0;
  for (const char* name : {"one", "two", "three"}) {
    add_sample(report, name, levels, {2.0, 3.0}, 1.0, Execution(1));
  }
  const test::Rows log = test::cells_of_lines(sample_lines(report));
  const Document json = Document::parse(sample_json(report));
  for (std::size_t k = 0; k < 3; ++k) {
    const GrainSample& sample = report.samples[k].sample;
    EXPECT_EQ(sample.values(5, 2), 1000.0 * scanned_table().values(5, 2));
    const double density = k == 0 ? 2.0 : 3.0;  // the last one is for all that follow
    const double mass = density * scanned_table().values.col(0).sum();
    EXPECT_EQ(json.at("samples").at(k).at("density"), density);
    EXPECT_NEAR(json.at("samples").at(k).at("mass").get<double>(), mass, 1e-9 * mass);
    const std::string line = "Mass of all grains: " + format_number(mass, 4);
    EXPECT_EQ(std::count(log.begin(), log.end(), std::vector<std::string>{line}), k == 0 ? 1 : 2);
  }
}

TEST(VoxelLines, TellErrorsAndTooManyNodes) {
  GrainTable table = scanned_table();
  const std::vector<std::string> lines = voxel_lines(table);
  ASSERT_EQ(lines.size(), 2U);
  // Hazen's quantiles of 8, 9, ..., 47; the area is .95 of the corrected one.
  EXPECT_TRUE(holds(lines[0], "11.5, 27.5, 43.5 (10, 50, 90 %)"));
  EXPECT_TRUE(holds(lines[0], "area -5"));
  EXPECT_TRUE(holds(lines[0], "sphericity of 1 of 40 grains"));
  // A node of each 2 by 2 voxels: .95 * 3 / 4 across^2 < 300 below 20.5 voxels.
  EXPECT_TRUE(holds(lines[1], "13 of 40 grains"));
  // The median grain is between those of 27 and 28: .7125 (27^2 + 28^2) / 2.
  EXPECT_TRUE(holds(lines[1], ": 539 are enough for the median grain"));
  const Eigen::VectorXd of_sphericity =
      100.0 * (table.values.col(3).array() / table.values.col(7).array() - 1.0);
  const std::string median = format_error(test::PlainStatistics(of_sphericity).quantile(0.5));
  EXPECT_TRUE(holds(lines[0], "sphericity " + median + " %"));
  table.values.col(8).setConstant(40.0);
  EXPECT_EQ(voxel_lines(table).size(), 1U);
  table.values.col(5).setConstant(std::nan(""));
  EXPECT_TRUE(voxel_lines(table).empty());
}

TEST(SampleReport, LinesFitATerminalAndNameTheSize) {
  SampleReport report = report_of(40, true);
  report.samples[0].sample.notes = {"A note that is longer than a line of a terminal, " +
                                    std::string("which is why it goes on in the next line.")};
  std::string text;
  for (const std::string& line : sample_lines(report)) {
    // Notes and the size stay whole: who shows them breaks them.
    EXPECT_TRUE(line.size() <= 80U || line == report.samples[0].sample.notes[0]) << line;
    text += line + "\n";
  }
  for (const char* part : {"first: 40 grains", "second & last", "second largest edge", "box, mm\n",
                           "D60", "Wasserstein", "convexity", "next line."}) {
    EXPECT_TRUE(holds(text, part));
  }
}

TEST(SampleReport, TheSummaryIsShortAndHasOneTable) {
  SampleReport one = report_of(40, false);
  SampleReport two = report_of(40, true);
  SampleReport levels = report_of(12, false);
  levels.levels = six_levels();
  for (const auto& [report, heading] : {std::pair(&one, "by number"),
                                        {&two, "Wasserstein / deviation"},
                                        {&levels, "90 % of errors, %"}}) {
    SCOPED_TRACE(heading);
    const std::vector<std::string> lines = summary_lines(*report);
    EXPECT_LE(lines.size(), 11U);  // with the seconds 12
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    std::size_t tables = 0;
    for (const char* other : {"  95 % from", "Wasserstein / deviation", "90 % of errors, %"}) {
      if (text.find(other) != std::string::npos) ++tables;
    }
    EXPECT_EQ(tables, 1U);
    EXPECT_TRUE(holds(text, heading));
    EXPECT_TRUE(holds(text, "\nconvexity "));
    for (const ReportedSample& sample : report->samples) {
      const SizeEstimates& sizes = sample.statistics.size_by_mass;
      EXPECT_TRUE(holds(text, "Sieve size, mm by mass: D10 " + shown(sizes.d10.value, sizes.d10) +
                                  ", D50 " + shown(sizes.d50.value, sizes.d50) + ", D90 " +
                                  shown(sizes.d90.value, sizes.d90)));
    }
  }
}

TEST(SampleReport, LeavesOutWhatNoGrainHasAndTellsExactErrors) {
  SampleReport report = report_of(5, false);
  report.samples[0].statistics.columns[2].count = 0;  // of axis_s_box
  const std::string page = sample_html(report, Execution(1));
  std::vector<std::string> names;
  for (const auto& row : test::table_named(page, "descriptor")) names.push_back(row.at(0));
  EXPECT_EQ(names,
            (std::vector<std::string>{
                "descriptor", in_words.at("volume") + ", mm^3", in_words.at("axis_i_box") + ", mm",
                in_words.at("axis_l_box") + ", mm", in_words.at("convexity")}));
  DetailLevels levels;
  levels.nodes = {100.0};
  for (const char* name : {"volume", "convexity"})
    levels.rows.push_back({name, {{1.0, 1e-13, 5}}, 100.0});
  levels.rows[1].levels[0].count = 0;
  report.levels = levels;
  std::size_t seen = 0;
  for (const auto& cells : test::cells_of_lines(sample_lines(report))) {
    if (cells.size() != 3) continue;
    EXPECT_NE(cells[0], "convexity");
    if (cells[0] != "volume") continue;
    ++seen;
    EXPECT_EQ(cells[1], "exact");
  }
  EXPECT_EQ(seen, 1U);
}

class SampleReportFile : public test::FileFolder {};

TEST_F(SampleReportFile, HasTheFormOfItsName) {
  const SampleReport report = report_of(5, true);
  for (const auto& [name, text] : {std::pair("a.html", sample_html(report, Execution(1))),
                                   {"a.json", sample_json(report)},
                                   {"a.csv", sample_csv(report)}}) {
    write_sample_report(path(name), report, Execution(1));
    EXPECT_EQ(content(name), text) << name;
  }
}

TEST(SampleReport, APageHoldsItsDataAndLoadsNothing) {
  SampleReport report = report_of(30, true);
  const fs::path folder = fs::path(testing::TempDir()) / "wscvt_sample_page";
  fs::create_directories(folder);
  write_mesh(test::sphere(1), (folder / "4.ply").string());
  report.samples[0].folder = folder.string();
  const std::string page = sample_html(report, Execution(1));
  fs::remove_all(folder);
  const Document data = data_of(page);
  const Document& first = data.at("samples").at(0);
  EXPECT_EQ(first.at("grains").at(4), "script><!--4") << "names without folders";
  EXPECT_FALSE(holds(page, "<!--")) << "names end no element and begin no comment";
  EXPECT_EQ(first.at("size").at(4), 5.0);
  EXPECT_EQ(first.at("values").at(0).at(4), 125.0);
  EXPECT_TRUE(first.at("values").at(4).at(1).is_null());
  EXPECT_EQ(first.at("thumbs").size(), 1U);
  EXPECT_EQ(first.at("thumbs").at("4").get<std::string>().rfind("data:image/png;base64,", 0), 0U);
  EXPECT_TRUE(data.at("levels").is_null());
  EXPECT_FALSE(holds(page, "src=\"http"));
  EXPECT_FALSE(holds(page, "<link"));
  EXPECT_TRUE(holds(page, "second &amp; last"));
  // Each figure that the script fills has its place.
  for (const char* id : {"curves", "forms-choice", "forms", "distributions-choice", "distributions",
                         "needed", "wanted", "thumb-choice", "thumbs"}) {
    EXPECT_TRUE(holds(page, "id=\"" + std::string(id) + "\"")) << id;
  }
}

TEST(SampleReport, NeedsNoNumberOfGrainsWithoutIntervals) {
  SampleReport report = report_of(6, false);
  EXPECT_GT(data_of(sample_html(report, Execution(1))).at("needed").size(), 3U);
  SampleOptions options = report.options;
  options.repetitions = 0;
  report.samples[0].statistics = measure_sample(report.samples[0].sample, options, Execution(1));
  EXPECT_TRUE(data_of(sample_html(report, Execution(1))).at("needed").empty());
}

TEST(SampleReport, APageOfManyGrainsStaysSmall) {
  SampleReport report = report_of(30, false);
  GrainSample& sample = report.samples[0].sample;
  constexpr Eigen::Index grains = 20000;
  sample.sizes = Eigen::VectorXd::LinSpaced(grains, 1.0, 1e6);
  sample.masses = sample.sizes / 3.0;
  sample.values = sample.sizes.array().sin().matrix() * Eigen::RowVectorXd::Constant(5, 1.0 / 7.0);
  sample.grains.assign(static_cast<std::size_t>(grains), "folder/grain_12345.ply");
  const std::string page = sample_html(report, Execution(1));
  // Half of the grains, of which the first and the last are among them.
  const Document sizes = data_of(page).at("samples").at(0).at("size");
  ASSERT_EQ(sizes.size(), 10000U);
  EXPECT_EQ(sizes.front(), 1.0);
  EXPECT_EQ(sizes.back(), 1e6);
  EXPECT_TRUE(holds(page, "Figures show 10000 of the grains"));
  // 50 descriptors of them fit in 6 MB with a name and a number.
  const double bytes_a_number = (static_cast<double>(page.size()) - 10000.0 * 18.0) / 70000.0;
  EXPECT_LT(bytes_a_number, 11.0);
}

// What a person reads first is open; of all rows only their number is seen.
TEST(SampleReport, ALongTableIsCollapsed) {
  GrainTable table;
  for (const char* name : {"volume", "axis_i_box", "convexity", "sphericity_wadell", "genus"}) {
    table.columns.push_back({name, ""});
  }
  for (int k = 0; k < 15; ++k) table.columns.push_back({"other_" + std::to_string(k), ""});
  const auto columns = static_cast<Eigen::Index>(table.columns.size());
  table.values.resize(6, columns);
  for (Eigen::Index row = 0; row < 6; ++row) {
    table.grains.push_back("g" + std::to_string(row));
    for (Eigen::Index k = 0; k < columns; ++k) {
      table.values(row, k) =
          k == 4
              ? 0.0
              : 1.0 + std::abs(std::sin(7.3 * static_cast<double>(row) + static_cast<double>(k)));
    }
  }
  SampleReport report;
  report.options.repetitions = 50;
  add_sample(report, "one", {{table}, {}}, {}, 1.0, Execution(1));
  const auto first_cells = [](const test::Rows& rows) {
    std::vector<std::string> cells;
    for (const auto& row : rows) cells.push_back(row.at(0));
    return cells;
  };
  std::string page = sample_html(report, Execution(1));
  EXPECT_EQ(
      first_cells(test::table_named(page, "descriptor")),
      (std::vector<std::string>{"descriptor", "convexity V / V(hull)", "sphericity (Wadell)"}));
  const test::Rows all = test::table_named(page, "descriptor", 1);
  EXPECT_EQ(all.size(), 21U);
  const std::size_t collapsed = page.find("<details><summary>All 20 rows</summary>");
  ASSERT_NE(collapsed, std::string::npos);
  EXPECT_LT(collapsed, page.find("<td>other 14</td>"));
  // A value that all grains share needs no grains.
  std::vector<std::string> needed;
  const Document data = data_of(page);
  for (const Document& row : data.at("needed")) needed.push_back(row.at("name"));
  EXPECT_EQ(needed.size(), 3U + 19U);
  EXPECT_EQ(std::count(needed.begin(), needed.end(), "mean of genus"), 0);
  // With the other sample, the comparison is a long table too.
  add_sample(report, "two", {{table}, {}}, {}, 1.0, Execution(1));
  compare_samples(report, Execution(1));
  page = sample_html(report, Execution(1));
  EXPECT_EQ(first_cells(test::table_named(page, "descriptor")),
            (std::vector<std::string>{"descriptor", "size", "convexity V / V(hull)",
                                      "sphericity (Wadell)"}));
  EXPECT_EQ(test::table_named(page, "descriptor", 1).size(), 22U);
}

TEST_F(SampleReportFile, KnowsTheBatchOfItsFolderButNoOtherTable) {
  file("shape.csv", "grain,file,volume,axis_i_box\r\na,a.ply,1,1\r\nb,b.ply,2,1.25\r\n");
  for (const bool is_batch : {false, true}) {
    RemeshResult result;
    result.rms_distance = 0.5;
    result.input.equivalent_radius = 1.0;
    file("grains.csv", is_batch
                           ? sample_header() + sample_row("b", result) + failed_row("c", "Broken.")
                           : std::string("grain,status\r\nb,done\r\n"));
    SampleReport report;
    report.options.repetitions = 0;
    add_sample(report, "one", read_sample(path(""), Execution(1)), {}, 1.0, Execution(1));
    const auto& batch = report.samples.front().batch;
    ASSERT_EQ(batch.has_value(), is_batch);
    const std::string page = sample_html(report, Execution(1));
    EXPECT_EQ(page.find("Broken.") != std::string::npos, is_batch);
    EXPECT_EQ(page.find("one: 2 grains. Size") != std::string::npos, !is_batch);
    if (!is_batch) continue;
    EXPECT_TRUE(holds(page, "one: 2 grains: 1 remeshed, 0 of them with warnings, 1 failed."));
    ASSERT_EQ(batch->farthest.size(), 1U);
    EXPECT_EQ(fs::path(batch->farthest[0].file).filename(), "b.ply");
  }
}

// 5000 grains of each are in the page, and 50 of those have pictures.
TEST_F(SampleReportFile, OfTwoLargeSamplesShowsHalfOfEach) {
  write_mesh(test::tetrahedron(1.0), path("a.ply"));
  SampleReport report = report_of(5, true);
  constexpr Eigen::Index grains = 6000;
  for (ReportedSample& one : report.samples) {
    GrainSample& sample = one.sample;
    one.folder = folder_.string();
    sample.sizes.resize(grains);
    sample.grains.clear();
    sample.files.clear();
    for (Eigen::Index k = 0; k < grains; ++k) {
      sample.sizes[k] = 1.0 + static_cast<double>((k * 7) % grains);  // each of 1 to 6000 once
      sample.grains.push_back(std::to_string(k));
      // Of the first sample, the odd grains have no file.
      sample.files.push_back(&one != &report.samples.front() || k % 2 == 0 ? "a.ply" : "none.ply");
    }
    sample.masses = sample.sizes;
    sample.values.setOnes(grains, 5);
  }
  const std::string page = sample_html(report, Execution(1));
  EXPECT_TRUE(holds(page, "<h1>Samples first and second &amp; last</h1>"));
  EXPECT_EQ(test::count_of(page, "Figures show 5000 of the grains"), 2U);
  const Document samples = data_of(page).at("samples");
  EXPECT_EQ(samples.at(0).at("sizeName"), "sieve size, mm");
  for (std::size_t s = 0; s < 2; ++s) {
    const Document& grains_ = samples.at(s).at("grains");
    ASSERT_EQ(grains_.size(), 5000U);
    std::vector<double> shown;
    for (const auto& [row, picture] : samples.at(s).at("thumbs").items()) {
      const int grain = std::stoi(grains_.at(std::stoul(row)).get<std::string>());
      if (s == 0) {
        EXPECT_EQ(grain % 2, 0);
      }
      shown.push_back(report.samples[s].sample.sizes[grain]);
    }
    std::sort(shown.begin(), shown.end());
    if (s == 0) {
      EXPECT_GT(shown.size(), 10U);
      EXPECT_LT(shown.size(), 40U);
      continue;
    }
    ASSERT_EQ(shown.size(), 50U);
    EXPECT_EQ(shown.front(), 1.0);
    EXPECT_EQ(shown.back(), 6000.0);
    for (std::size_t k = 1; k < 50; ++k) EXPECT_NEAR(shown[k] - shown[k - 1], 5999.0 / 49.0, 3.0);
  }
}

/// The sizes of a sample, by their definitions.
std::vector<std::pair<std::string, double>> plain_sizes(const test::PlainStatistics& plain) {
  const double d10 = plain.quantile(0.1), d30 = plain.quantile(0.3), d60 = plain.quantile(0.6);
  return {{"D10", d10},
          {"D30", d30},
          {"D50", plain.quantile(0.5)},
          {"D60", d60},
          {"D90", plain.quantile(0.9)},
          {"Cu", d60 / d10},
          {"Cc", d30 * d30 / (d10 * d60)}};
}

Estimate size_of(const SizeEstimates& sizes, const std::string& name) {
  const std::pair<const char*, Estimate> all[] = {
      {"D10", sizes.d10}, {"D30", sizes.d30},       {"D50", sizes.d50},     {"D60", sizes.d60},
      {"D90", sizes.d90}, {"Cu", sizes.uniformity}, {"Cc", sizes.curvature}};
  for (const auto& [key, estimate] : all) {
    if (key == name) return estimate;
  }
  return {};
}

TEST(SampleReportNumbers, OfTheSizesAreThoseOfTheGrains) {
  const SampleReport report = report_of(23, true);
  const test::Rows page = test::table_named(sample_html(report, Execution(1)), "size");
  const Document json = Document::parse(sample_json(report));
  const auto csv = test::csv_records(sample_csv(report));
  ASSERT_EQ(page.size(), 8U);
  EXPECT_EQ(page[0],
            (std::vector<std::string>{"size", "first, by mass", "first, by number",
                                      "second & last, by mass", "second & last, by number"}));
  std::size_t csv_rows = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const ReportedSample& one = report.samples[k];
    for (const bool by_mass : {true, false}) {
      const test::PlainStatistics plain(
          one.sample.sizes,
          by_mass ? one.sample.masses : Eigen::VectorXd(Eigen::VectorXd::Ones(23)));
      const SizeEstimates& sizes =
          by_mass ? one.statistics.size_by_mass : one.statistics.size_by_number;
      const test::Rows log = test::cells_of_lines(sample_lines(report));
      std::size_t row = 0;
      for (const auto& [name, value] : plain_sizes(plain)) {
        SCOPED_TRACE(one.name + " " + name + (by_mass ? " by mass" : " by number"));
        const Estimate interval = size_of(sizes, name);
        ++row;
        EXPECT_EQ(page[row][0].substr(0, name.size()), name);
        EXPECT_EQ(page[row][1 + 2 * k + (by_mass ? 0 : 1)], shown(value, interval));
        const Document& in_json =
            json.at("samples").at(k).at("size").at(by_mass ? "by_mass" : "by_number").at(name);
        EXPECT_NEAR(in_json.at("value").get<double>(), value, 1e-12 * value);
        EXPECT_EQ(in_json.at("lower"), interval.lower);
        EXPECT_EQ(in_json.at("upper"), interval.upper);
        for (const auto& record : csv) {
          if (record[0] != one.name || record[1] != "size" || record[4] != name) continue;
          if (record[3] != (by_mass ? "mass" : "number")) continue;
          ++csv_rows;
          EXPECT_EQ(record[2], name[0] == 'C' ? "" : "mm");  // ratios have no unit
          EXPECT_NEAR(std::stod(record[5]), value, 1e-12 * value);
          EXPECT_EQ(std::stod(record[6]), interval.lower);
          EXPECT_EQ(std::stod(record[7]), interval.upper);
        }
        // The log has both weightings in a line; its second such line is of the second sample.
        std::size_t seen = 0;
        for (const auto& cells : log) {
          if (cells.empty() || cells[0] != name || seen++ != k) continue;
          ASSERT_EQ(cells.size(), 7U);
          const std::size_t at = by_mass ? 1 : 4;
          EXPECT_EQ(cells[at], format_number(value, 4));
          EXPECT_EQ(cells[at + 1], format_number(interval.lower, 4));
          EXPECT_EQ(cells[at + 2], format_number(interval.upper, 4));
        }
        EXPECT_EQ(seen, 2U);
      }
    }
    double mass = 0.0;
    for (const double own : one.sample.masses) mass += own;
    EXPECT_NEAR(json.at("samples").at(k).at("mass").get<double>(), mass, 1e-12 * mass);
  }
  EXPECT_EQ(csv_rows, 28U);
}

TEST(SampleReportNumbers, OfTheDescriptorsAreThoseOfTheGrains) {
  const SampleReport report = report_of(23, true);
  const std::string html = sample_html(report, Execution(1));
  const Document json = Document::parse(sample_json(report));
  const auto csv = test::csv_records(sample_csv(report));
  for (std::size_t k = 0; k < 2; ++k) {
    const ReportedSample& one = report.samples[k];
    const test::Rows page = test::table_named(html, "descriptor", 1 + k);  // 0: the comparison
    ASSERT_EQ(page.size(), 1 + one.sample.columns.size());
    EXPECT_EQ(page[0], (std::vector<std::string>{"descriptor", "grains", "mean by number",
                                                 "std. dev. (n - 1)", "10 %", "median", "90 %",
                                                 "mean by mass", "correlation with size"}));
    for (std::size_t c = 0; c < one.sample.columns.size(); ++c) {
      const GrainColumn& column = one.sample.columns[c];
      SCOPED_TRACE(one.name + " " + column.name);
      const Eigen::VectorXd values = one.sample.values.col(static_cast<Eigen::Index>(c));
      const test::PlainStatistics by_number(values);
      const test::PlainStatistics by_mass(values, one.sample.masses);
      const double correlation = test::plain_rank_correlation(one.sample.sizes, values);
      const ColumnStatistics& s = one.statistics.columns[c];
      EXPECT_EQ(
          page[1 + c],
          (std::vector<std::string>{
              in_words.at(column.name) + (column.unit.empty() ? "" : ", " + column.unit),
              std::to_string(by_number.grains().size()), shown(by_number.mean(), s.by_number.mean),
              format_number(by_number.deviation(), 4), format_number(by_number.quantile(0.1), 4),
              format_number(by_number.quantile(0.5), 4), format_number(by_number.quantile(0.9), 4),
              format_number(by_mass.mean(), 4), shown(correlation, s.size_correlation)}));
      const Document& in_json = json.at("samples").at(k).at("descriptors").at(column.name);
      EXPECT_EQ(in_json.at("unit"), column.unit);
      EXPECT_EQ(in_json.at("count"), by_number.grains().size());
      EXPECT_EQ(in_json.at("minimum"), by_number.grains().front().first);
      EXPECT_EQ(in_json.at("maximum"), by_number.grains().back().first);
      EXPECT_NEAR(in_json.at("size_correlation").at("value").get<double>(), correlation, 1e-12);
      for (const auto& [weighting, plain, estimates] :
           {std::tuple("number", by_number, s.by_number), std::tuple("mass", by_mass, s.by_mass)}) {
        const std::tuple<const char*, double, Estimate> expected[] = {
            {"mean", plain.mean(), estimates.mean},
            {"standard_deviation", plain.deviation(), estimates.deviation},
            {"percent_10", plain.quantile(0.1), estimates.percent_10},
            {"median", plain.quantile(0.5), estimates.median},
            {"percent_90", plain.quantile(0.9), estimates.percent_90}};
        for (const auto& [statistic, value, estimate] : expected) {
          SCOPED_TRACE(std::string(statistic) + " by " + weighting);
          const double rounding = 1e-12 * std::abs(value);
          const Document& found = in_json.at(std::string("by_") + weighting).at(statistic);
          EXPECT_NEAR(found.at("value").get<double>(), value, rounding);
          EXPECT_EQ(found.at("lower"), estimate.lower);
          EXPECT_EQ(found.at("upper"), estimate.upper);
          std::size_t rows = 0;
          for (const auto& record : csv) {
            if (record[0] != one.name || record[1] != column.name) continue;
            if (record[3] != weighting || record[4] != statistic) continue;
            ++rows;
            EXPECT_EQ(record[2], column.unit);
            EXPECT_NEAR(std::stod(record[5]), value, rounding);
            EXPECT_EQ(std::stod(record[6]), estimate.lower);
            EXPECT_EQ(std::stod(record[7]), estimate.upper);
          }
          EXPECT_EQ(rows, 1U);
        }
      }
      for (const auto& record : csv) {
        if (record[0] != one.name || record[1] != column.name) continue;
        if (record[4] != "size_correlation") continue;
        EXPECT_EQ(record[2], "");
        EXPECT_NEAR(std::stod(record[5]), correlation, 1e-12);
      }
    }
    // The log has the main ones alone: the mean by number with its interval, median, mean by mass.
    std::size_t seen = 0;
    for (const auto& cells : test::cells_of_lines(sample_lines(report))) {
      if (cells.empty() || cells[0] != "convexity" || cells.size() != 6) continue;
      if (seen++ != k) continue;
      const Eigen::VectorXd values = one.sample.values.col(4);
      const Estimate& mean = one.statistics.columns[4].by_number.mean;
      const test::PlainStatistics plain(values);
      EXPECT_EQ(cells,
                (std::vector<std::string>{
                    "convexity", format_number(plain.mean(), 4), format_number(mean.lower, 4),
                    format_number(mean.upper, 4), format_number(plain.quantile(0.5), 4),
                    format_number(test::PlainStatistics(values, one.sample.masses).mean(), 4)}));
    }
    EXPECT_EQ(seen, 2U);
  }
}

TEST(SampleReportNumbers, OfGrainsThatAreAllEqualAreNoDistanceInDeviations) {
  SampleReport report = report_of(23, true);
  GrainSample& first = report.samples[0].sample;
  first.values.col(0).setConstant(0.1);
  report.comparison =
      compare_samples(first, report.samples[1].sample, report.options, Execution(1));
  const std::string name = first.columns[0].name;
  const test::Rows page = test::table_named(sample_html(report, Execution(1)), "descriptor");
  ASSERT_EQ(report.comparison[1].column.name, name);
  EXPECT_EQ(report.comparison[1].deviation, 0.0);
  EXPECT_GT(report.comparison[1].by_number.wasserstein, 0.0);
  for (const std::size_t cell : {3, 7}) EXPECT_EQ(page[2][cell], "-") << page[2][0];
  for (const std::string& line : sample_lines(report)) {
    EXPECT_FALSE(holds(line, " inf"));
  }
}

TEST(SampleReportNumbers, OfTheComparisonAreThoseOfBothSamples) {
  const SampleReport report = report_of(23, true);
  const test::Rows page = test::table_named(sample_html(report, Execution(1)), "descriptor");
  const Document json = Document::parse(sample_json(report)).at("comparison");
  const auto csv = test::csv_records(sample_csv(report));
  std::size_t in_csv = 0;
  const GrainSample& a = report.samples[0].sample;
  const GrainSample& b = report.samples[1].sample;
  ASSERT_EQ(page.size(), 2 + a.columns.size());
  EXPECT_EQ(json.size(), 1 + a.columns.size());
  for (std::size_t k = 0; k < report.comparison.size(); ++k) {
    const ColumnComparison& row = report.comparison[k];
    SCOPED_TRACE(row.column.name);
    const auto values = [&](const GrainSample& sample) {
      return k == 0 ? sample.sizes
                    : Eigen::VectorXd(sample.values.col(static_cast<Eigen::Index>(k) - 1));
    };
    const double deviation = test::PlainStatistics(values(a)).deviation();
    std::vector<std::string> expected = {in_words.at(row.column.name) +
                                         (row.column.unit.empty() ? "" : ", " + row.column.unit)};
    for (const bool by_mass : {false, true}) {
      const auto plain = [&](const GrainSample& sample) {
        return by_mass ? test::PlainStatistics(values(sample), sample.masses)
                       : test::PlainStatistics(values(sample));
      };
      const auto [largest, area] = test::plain_distances(plain(a), plain(b));
      const SampleDistance& d = by_mass ? row.by_mass : row.by_number;
      for (const double value : {largest, d.kolmogorov_p, area / deviation, d.wasserstein_p}) {
        expected.push_back(format_number(value, 3));
      }
      const Document& found = json.at(row.column.name).at(by_mass ? "by_mass" : "by_number");
      EXPECT_NEAR(found.at("kolmogorov_smirnov").get<double>(), largest, 1e-12);
      EXPECT_NEAR(found.at("wasserstein").get<double>(), area, 1e-12 * (1.0 + area));
      EXPECT_EQ(found.at("kolmogorov_smirnov_p"), d.kolmogorov_p);
      EXPECT_EQ(found.at("wasserstein_p"), d.wasserstein_p);
      for (const auto& record : csv) {
        const bool is_this = record[0] == "first and second & last" &&
                             record[1] == row.column.name &&
                             record[3] == (by_mass ? "mass" : "number");
        if (!is_this) continue;
        ++in_csv;
        EXPECT_EQ(found.at(record[4]).get<double>(), std::stod(record[5])) << record[4];
        EXPECT_EQ(record[2], record[4] == "wasserstein" ? row.column.unit : "");
      }
    }
    ASSERT_EQ(page[1 + k].size(), 9U);
    for (std::size_t cell = 0; cell < 9; ++cell) {
      // Distances of 0 are sums of rounding.
      if (expected[cell].find("e-") != std::string::npos) continue;
      if (page[1 + k][cell].find("e-") != std::string::npos) continue;
      EXPECT_EQ(page[1 + k][cell], expected[cell]) << page[0][cell];
    }
    EXPECT_NEAR(json.at(row.column.name).at("deviation").get<double>(), deviation,
                1e-12 * deviation);
  }
  EXPECT_EQ(in_csv, 8 * report.comparison.size());
  std::size_t seen = 0;
  for (const auto& cells : test::cells_of_lines(sample_lines(report))) {
    if (cells.size() != 5 || cells[0] != "size") continue;
    ++seen;
    const SampleDistance& d = report.comparison[0].by_number;
    EXPECT_NE(d.kolmogorov, report.comparison[0].by_mass.kolmogorov);
    EXPECT_EQ(cells[1], format_number(d.kolmogorov, 4));
    EXPECT_EQ(cells[2], format_number(d.kolmogorov_p, 4));
    EXPECT_EQ(cells[3], format_number(d.wasserstein / report.comparison[0].deviation, 4));
    EXPECT_EQ(cells[4], format_number(d.wasserstein_p, 4));
  }
  EXPECT_EQ(seen, 1U);
}

TEST(SampleReportNumbers, OfTheLevelsStandUnderTheirNames) {
  SampleReport report = report_of(12, false);
  report.levels = six_levels();
  const std::string html = sample_html(report, Execution(1));
  const test::Rows page = test::table_named(html, "median, 90 % of the errors");
  ASSERT_EQ(page.size(), 5U);
  EXPECT_EQ(page[0],
            (std::vector<std::string>{"median, 90 % of the errors", "N = 100", "N = 200", "N = 400",
                                      "N = 800", "N = 1600", "N = 3200", "N for 1.5 %"}));
  const Document json = Document::parse(sample_json(report)).at("levels");
  EXPECT_EQ(json.at("mark_percent"), 1.5);
  const Document data = data_of(html).at("levels");
  EXPECT_EQ(data.at("mark"), 1.5);
  EXPECT_EQ(data.at("nodes"), Document(report.levels->nodes));
  const auto csv = test::csv_records(sample_csv(report));
  const test::Rows log = test::cells_of_lines(sample_lines(report));
  for (std::size_t r = 0; r < 4; ++r) {
    const DescriptorLevels& row = report.levels->rows[r];
    SCOPED_TRACE(row.name);
    const std::string unit = r == 3 ? "|degrees" : "|%";
    ASSERT_EQ(page[1 + r].size(), 8U);
    EXPECT_EQ(page[1 + r][0], in_words.at(row.name) + (r == 3 ? ", degrees" : ""));
    EXPECT_EQ("|" + json.at("descriptors").at(row.name).at("unit").get<std::string>(), unit);
    EXPECT_EQ("|" + data.at("rows").at(r).at("unit").get<std::string>(), unit);
    EXPECT_EQ(data.at("rows").at(r).at("words"), in_words.at(row.name));
    EXPECT_EQ(page[1 + r][7], format_number(row.nodes_needed, 4));
    EXPECT_EQ(data.at("rows").at(r).at("name"), row.name);
    EXPECT_EQ(json.at("descriptors").at(row.name).at("nodes_needed"), row.nodes_needed);
    std::map<std::string, double> in_csv;
    for (const auto& record : csv) {
      if (record[0] == "first" && record[1] == row.name && record[3] == "number" &&
          record[4].find('n') != std::string::npos && record[6].empty()) {
        in_csv[record[4] + "|" + record[2]] = std::stod(record[5]);
      }
    }
    EXPECT_EQ(in_csv.at("nodes_needed|"), row.nodes_needed);
    for (std::size_t l = 0; l < 6; ++l) {
      const LevelError& error = row.levels[l];
      const std::string nodes = format_number(report.levels->nodes[l], 9);
      const std::string median = error.median < 1e-9 ? "exact" : format_number(error.median, 3);
      EXPECT_EQ(page[1 + r][1 + l],
                error.count == 0 ? "-" : median + ", " + format_number(error.percent_90, 3));
      const Document& found = json.at("descriptors").at(row.name).at("errors").at(l);
      EXPECT_EQ(found.at("nodes"), report.levels->nodes[l]);
      EXPECT_EQ(found.at("grains"), error.count);
      EXPECT_EQ(found.at("median_percent"), error.median);
      EXPECT_EQ(found.at("percent_90_percent"), error.percent_90);
      EXPECT_EQ(data.at("rows").at(r).at("median").at(l), error.median);
      EXPECT_EQ(data.at("rows").at(r).at("percent_90").at(l), error.percent_90);
      EXPECT_EQ(in_csv.at("error_median_n" + nodes + unit), error.median);
      EXPECT_EQ(in_csv.at("error_percent_90_n" + nodes + unit), error.percent_90);
    }
  }
  // The terminal has room for the last four.
  const auto head = std::find_if(log.begin(), log.end(), [](const std::vector<std::string>& cells) {
    return !cells.empty() && cells[0] == "90 % of errors, %";
  });
  ASSERT_NE(head, log.end());
  EXPECT_EQ(*head, (std::vector<std::string>{"90 % of errors, %", "N 400", "N 800", "N 1600",
                                             "N 3200", "N for 1.5 %"}));
  for (std::size_t r = 0; r < 4; ++r) {
    const DescriptorLevels& row = report.levels->rows[r];
    std::vector<std::string> expected = {row.name + (r == 3 ? ", degrees" : "")};
    for (std::size_t l = 2; l < 6; ++l) {
      expected.push_back(format_number(row.levels[l].percent_90, 4));
    }
    expected.push_back(format_number(row.nodes_needed, 4));
    EXPECT_EQ(*(head + 1 + static_cast<std::ptrdiff_t>(r)), expected);
  }
}

TEST(SampleReportNumbers, TellGrainsFailuresNotesAndWhatIsDrawn) {
  SampleReport report = report_of(12, true);
  report.samples[0].sample.failed = 3;
  report.samples[1].sample.notes = {"One note."};
  const std::string html = sample_html(report, Execution(1));
  EXPECT_TRUE(holds(html, "<p>first: 12 grains, 3 failed. Size: "));
  EXPECT_TRUE(holds(html, "<p>second &amp; last: 12 grains. Size: "));
  EXPECT_TRUE(holds(html, "<p class=\"warning\">One note.</p>"));
  EXPECT_TRUE(holds(html, "95 % intervals from 20 random samples"));
  EXPECT_TRUE(holds(html, "seed " + std::to_string(report.options.seed) + ")"));
  const auto lines = sample_lines(report);
  EXPECT_NE(std::find(lines.begin(), lines.end(), "first: 12 grains, 3 failed"), lines.end());
  EXPECT_NE(std::find(lines.begin(), lines.end(), "second & last: 12 grains"), lines.end());
  const Document json = Document::parse(sample_json(report));
  EXPECT_EQ(json.at("samples").at(0).at("failed"), 3);
  EXPECT_EQ(json.at("samples").at(1).at("failed"), 0);
  EXPECT_EQ(json.at("samples").at(0).at("repetitions"), 20);
  EXPECT_EQ(json.at("samples").at(1).at("notes"), Document({"One note."}));
  EXPECT_EQ(json.at("options").at("repetitions"), 20);
  EXPECT_EQ(json.at("options").at("size"), "sieve");
  EXPECT_EQ(json.at("options").at("seed"), report.options.seed);

  const Document data = data_of(html);
  for (std::size_t k = 0; k < 2; ++k) {
    const GrainSample& sample = report.samples[k].sample;
    const Document& drawn = data.at("samples").at(k);
    EXPECT_EQ(drawn.at("name"), report.samples[k].name);
    EXPECT_EQ(drawn.at("count"), 12);
    for (std::size_t c = 0; c < sample.columns.size(); ++c) {
      EXPECT_EQ(drawn.at("columns").at(c).at("name"), sample.columns[c].name);
      EXPECT_EQ(drawn.at("columns").at(c).at("unit"), sample.columns[c].unit);
    }
    for (Eigen::Index row = 0; row < 12; ++row) {
      const auto at = static_cast<std::size_t>(row);
      // Four digits are drawn.
      EXPECT_NEAR(drawn.at("size").at(at).get<double>(), sample.sizes[row],
                  5e-4 * sample.sizes[row]);
      EXPECT_NEAR(drawn.at("mass").at(at).get<double>(), sample.masses[row],
                  5e-4 * sample.masses[row]);
      for (std::size_t c = 0; c < sample.columns.size(); ++c) {
        const double value = sample.values(row, static_cast<Eigen::Index>(c));
        const Document& found = drawn.at("values").at(c).at(at);
        if (std::isnan(value)) {
          EXPECT_TRUE(found.is_null());
        } else {
          EXPECT_NEAR(found.get<double>(), value, 5e-4 * value);
        }
      }
    }
  }
  // How many grains an interval needs is told of the first sample.
  const SampleStatistics& s = report.samples[0].statistics;
  std::vector<std::pair<std::string, Estimate>> needed = {{"D10 by mass", s.size_by_mass.d10},
                                                          {"D50 by mass", s.size_by_mass.d50},
                                                          {"D60 by mass", s.size_by_mass.d60}};
  const std::map<std::string, std::string> words = {{"axis_l_box", "axis L (oriented box)"},
                                                    {"axis_i_box", "axis I (oriented box)"},
                                                    {"axis_s_box", "axis S (oriented box)"},
                                                    {"convexity", "convexity V / V(hull)"}};
  for (const ColumnStatistics& column : s.columns) {
    const auto known = words.find(column.column.name);
    needed.emplace_back("mean of " + (known == words.end() ? column.column.name : known->second),
                        column.by_number.mean);
  }
  ASSERT_EQ(data.at("needed").size(), needed.size());
  for (std::size_t k = 0; k < needed.size(); ++k) {
    EXPECT_EQ(data.at("needed").at(k).at("name"), needed[k].first);
    EXPECT_EQ(data.at("needed").at(k).at("value"), needed[k].second.value);
    EXPECT_EQ(data.at("needed").at(k).at("lower"), needed[k].second.lower);
    EXPECT_EQ(data.at("needed").at(k).at("upper"), needed[k].second.upper);
  }
}

}  // namespace
}  // namespace wscvt
