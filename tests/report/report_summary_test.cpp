// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"

namespace wscvt {
namespace {

RemeshResult remesh_of(const IndexedMesh& scan, int nodes) {
  RemeshOptions options;
  options.node_count = nodes;
  return remesh(scan, options, Execution(1));
}

std::string line_of(const std::vector<std::string>& lines, const std::string& topic) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.rfind(topic + " ", 0) == 0;
  });
  return found == lines.end() ? "" : *found;
}

/// The number behind a word of a line.
double number_behind(const std::string& line, const std::string& word) {
  const std::size_t at = line.find(word);
  return at == std::string::npos ? 1e300 : std::stod(line.substr(at + word.size()));
}

TEST(ReportSummary, TellsTheErrorsThatAPlainComputationGives) {
  const RemeshResult result = remesh_of(test::lumpy(5), 300);
  const std::vector<std::string> lines = summary_lines(result);
  const auto percent = [](double value, double scan) { return 100.0 * (value - scan) / scan; };
  std::string errors;  // may be two lines
  for (const std::string& line : lines) {
    if (line.rfind("Errors", 0) == 0 || (!errors.empty() && line.front() == ' ')) {
      errors += line.substr(errors.empty() ? 0 : 11);
    }
  }
  // Errors have three decimals.
  EXPECT_NE(errors.find("volume exact"), std::string::npos) << errors;
  EXPECT_NEAR(number_behind(errors, " area "), percent(result.remesh.area, result.scan.area), 6e-4);
  EXPECT_NEAR(number_behind(errors, "sphericity "),
              percent(result.remesh.sphericity, result.scan.sphericity), 6e-4);
  EXPECT_NEAR(number_behind(errors, "aspect ratio "),
              percent(result.remesh.aspect_ratio, result.scan.aspect_ratio), 6e-4);
  const std::string remeshed = line_of(lines, "Remesh");
  EXPECT_EQ(number_behind(remeshed, "Remesh"), 300.0);
  EXPECT_NEAR(number_behind(remeshed, "smallest angle "), result.quality.smallest_angle, 0.06);
  const double rms = 100.0 * result.rms_distance / result.input.equivalent_radius;
  const std::string distance = line_of(lines, "Distance");
  EXPECT_NEAR(number_behind(distance, "rms "), rms, 0.006 * rms);
  const double largest = 100.0 * result.largest_distance / result.input.equivalent_radius;
  EXPECT_NEAR(number_behind(distance, "largest "), largest, 0.006 * largest);
  EXPECT_GT(largest, rms);
}

TEST(ReportSummary, IsShortAndNarrowAlsoForARepairedScan) {
  IndexedMesh scan = test::lumpy(4);
  scan.triangles.resize(scan.triangles.size() - 3);
  scan.triangles.push_back(scan.triangles.front());
  scan.points.emplace_back(9.0, 9.0, 9.0);
  const std::vector<std::string> lines = summary_lines(remesh_of(scan, 150));
  EXPECT_NE(line_of(lines, "Repairs"), "");
  EXPECT_LE(lines.size(), 9U);
  for (const std::string& line : lines) EXPECT_LE(line.size(), 80U) << line;
}

TEST(ReportSummary, VerdictIsGoodWithoutWarningsOnly) {
  RemeshResult result = remesh_of(test::lumpy(4), 300);
  result.warnings.clear();
  const std::string good = verdict_line(result);
  EXPECT_EQ(good.rfind("300 nodes, volume exact, area ", 0), 0U) << good;
  EXPECT_EQ(good.substr(good.size() - 20), " of the radius: good") << good;
  result.warnings = {Sentence("One."), Sentence("Two.")};
  const std::string doubtful = verdict_line(result);
  EXPECT_EQ(doubtful.substr(doubtful.size() - 25), " of the radius: see above");
  EXPECT_LE(doubtful.size(), 80U) << doubtful;
}

}  // namespace
}  // namespace wscvt
