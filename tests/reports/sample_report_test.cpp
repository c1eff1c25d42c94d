// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/sample_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/flat_json.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Document = nlohmann::ordered_json;

/// Grains with sizes 1, 2, ..., whose names could end an element of a page.
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
        Eigen::VectorXd::LinSpaced(grains, 1.0, static_cast<double>(grains));
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

TEST(SampleReport, LinesFitATerminalAndNameTheSize) {
  SampleReport report = report_of(40, true);
  report.samples[0].sample.notes = {"A note that is longer than a line of a terminal, " +
                                    std::string("which is why it goes on in the next line.")};
  std::string text;
  for (const std::string& line : sample_lines(report)) {
    EXPECT_LE(line.size(), 80U) << line;
    text += line + "\n";
  }
  for (const char* part : {"first: 40 grains", "second & last", "second largest edge", "D60",
                           "Wasserstein", "convexity", "next line."}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST(SampleReport, FilesHoldTheStatistics) {
  const SampleReport report = report_of(40, true);
  const auto json = Document::parse(sample_json(report));
  const SampleStatistics& s = report.samples[1].statistics;
  EXPECT_EQ(json.at("options").at("size"), "sieve");
  const Document& second = json.at("samples").at(1);
  EXPECT_EQ(second.at("grains"), 40);
  EXPECT_EQ(second.at("size").at("by_mass").at("D50").at("value"), s.size_by_mass.d50.value);
  EXPECT_EQ(second.at("size").at("by_number").at("Cc").at("upper"),
            s.size_by_number.curvature.upper);
  const Document& convexity = second.at("descriptors").at("convexity");
  EXPECT_EQ(convexity.at("count"), 39);
  EXPECT_EQ(convexity.at("by_mass").at("standard_deviation").at("lower"),
            s.columns[4].by_mass.deviation.lower);
  EXPECT_EQ(json.at("comparison").at("axis_l_box").at("by_number").at("wasserstein"),
            report.comparison[4].by_number.wasserstein);
  std::size_t found = 0;
  for (const auto& row : test::csv_records(sample_csv(report))) {
    ASSERT_EQ(row.size(), 8U);
    if (row[0] != "second & last" || row[1] != "axis_s_box" || row[3] != "mass") continue;
    if (row[4] != "percent_90") continue;
    ++found;
    EXPECT_EQ(row[2], "mm");
    EXPECT_EQ(std::stod(row[5]), s.columns[2].by_mass.percent_90.value);
    EXPECT_EQ(std::stod(row[7]), s.columns[2].by_mass.percent_90.upper);
  }
  EXPECT_EQ(found, 1U);
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
  EXPECT_EQ(page.find("<!--"), std::string::npos) << "names end no element and begin no comment";
  EXPECT_EQ(first.at("size").at(4), 5.0);
  EXPECT_EQ(first.at("values").at(0).at(4), 125.0);
  EXPECT_TRUE(first.at("values").at(4).at(1).is_null());
  EXPECT_EQ(first.at("thumbs").size(), 1U);
  EXPECT_EQ(first.at("thumbs").at("4").get<std::string>().rfind("data:image/png;base64,", 0), 0U);
  EXPECT_TRUE(data.at("levels").is_null());
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_NE(page.find("second &amp; last"), std::string::npos);
  // Each figure that the script fills has its place.
  for (const char* id : {"curves", "forms-choice", "forms", "distributions-choice", "distributions",
                         "needed", "wanted", "thumb-choice", "thumbs"}) {
    EXPECT_NE(page.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;
  }
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
  EXPECT_NE(page.find("Figures show 10000 of the grains"), std::string::npos);
  // 50 descriptors of them fit in 6 MB with a name and a number.
  const double bytes_a_number = (static_cast<double>(page.size()) - 10000.0 * 18.0) / 70000.0;
  EXPECT_LT(bytes_a_number, 11.0);
}

}  // namespace
}  // namespace wscvt
