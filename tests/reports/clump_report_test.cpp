// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/clump_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/flat_json.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/test_shapes.h"
#include "toolbox/clump/first_contact.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"

namespace wscvt {
namespace {

using test::count_of;
using test::holds;

/// Of a grain without symmetry, off the origin.
const ClumpResult& shown_clump() {
  static const ClumpResult clump = [] {
    const IndexedMesh scan =
        test::moved(test::transformed(test::lumpy(3), Vector3(1.3, 1.0, 0.7).asDiagonal()), 2.0,
                    {-30.0, 5.0, 120.0});
    ClumpOptions options;
    options.sphere_count = 6;
    ClumpResult made = make_clump(scan, options, Execution(1));
    made.warnings = {"A sentence with <signs>."};
    return made;
  }();
  return clump;
}

TEST(ClumpReport, LinesAreFewAndFitIn80Columns) {
  const ClumpResult& clump = shown_clump();
  std::string all;
  for (const std::string& line : clump_lines(clump)) {
    EXPECT_LE(line.size(), 80U) << line;
    all += line + "\n";
  }
  EXPECT_LE(std::count(all.begin(), all.end(), '\n'), 11) << all;
  EXPECT_TRUE(holds(all, "6 spheres"));
  ClumpResult one = clump;
  one.spheres.resize(1);
  EXPECT_TRUE(holds(clump_lines(one)[1], "1 sphere,"));
}

TEST(ClumpReport, CsvHasAHeadingForEachValue) {
  std::istringstream lines(clump_csv(shown_clump(), {"grain.ply", ""}));
  std::string heading;
  std::string row;
  ASSERT_TRUE(std::getline(lines, heading) && std::getline(lines, row));
  EXPECT_EQ(count_of(heading, ","), count_of(row, ","));
  EXPECT_TRUE(holds(heading, "first_contact.mean_percent"));
  // Of an empty clump the columns are the same.
  std::istringstream others(clump_csv(ClumpResult()));
  std::string same;
  ASSERT_TRUE(std::getline(others, same));
  EXPECT_EQ(same, heading);
}

TEST(ClumpReport, PageShowsScanClumpDistanceAndEachTable) {
  const ClumpResult& clump = shown_clump();
  const std::string page = clump_html(clump, {"/scans/<grain>.ply", "2026-11-26"}, Execution(1));
  EXPECT_TRUE(holds(page, "<title>Clump of &lt;grain&gt;.ply with 6 spheres"));
  EXPECT_TRUE(holds(page, "A sentence with &lt;signs&gt;."));
  EXPECT_EQ(count_of(page, "<img"), 3U);  // scan, clump, clump with its distance
  // Scale of the colours, histogram of the distances, error against the number of spheres.
  EXPECT_EQ(count_of(page, "<svg"), 3U);
  EXPECT_TRUE(holds(page, "<title>signed distance to scan, length</title>"));
  EXPECT_TRUE(holds(page, "2026-11-26"));
  for (const std::string& line : clump_lines(clump)) {
    EXPECT_TRUE(holds(page, html_escaped(line)));
  }
  // Each sphere has a colour of its own. Of one sphere all faces have the number 0.
  EXPECT_EQ(count_of(page, "\"colours\":"), 1U);
  ClumpResult one = clump;
  one.spheres.resize(1);
  const std::string zeros(one.surface.triangles.size(), '\0');
  EXPECT_FALSE(holds(page, base64(zeros)));
  EXPECT_TRUE(holds(clump_html(one, {}, Execution(1)), base64(zeros)));
  EXPECT_FALSE(holds(page, "http"));
  EXPECT_FALSE(holds(page, ">nan"));
  EXPECT_EQ(page, clump_html(clump, {"/scans/<grain>.ply", "2026-11-26"}, Execution(2)));

  ClumpResult plain = clump;
  plain.stages.resize(1);
  plain.warnings.clear();
  const std::string less = clump_html(plain, {}, Execution(1));
  EXPECT_TRUE(holds(less, "<title>Clump with 6 spheres"));
  EXPECT_EQ(count_of(less, "<svg"), 2U);
  EXPECT_FALSE(holds(less, "A sentence"));
}

/// A result whose numbers are all different, and have no more than three digits.
ClumpResult numbered_clump() {
  ClumpResult clump = shown_clump();
  clump.equivalent_radius = 4.0;
  clump.rms_distance = 0.5;       // 12.5 %
  clump.largest_distance = 0.75;  // 18.75 %
  clump.intersection_over_union = 0.875;
  clump.contact = {-1.5, 2.25};
  clump.united.error = {3.5, 4.5, 5.5};
  clump.summed.error = {6.5, 7.5, 8.5};
  clump.input.vertices = 1234;
  clump.input.faces = 2464;
  clump.input.genus = 2;
  clump.stages = {{2, 3.0}, {4, 1.25}, {6, 0.5}};
  clump.spheres[1].radius = 0.03125;  // the smallest is neither the first nor the last
  return clump;
}

TEST(ClumpReportNumbers, StandUnderTheirNamesInPageAndLog) {
  const ClumpResult clump = numbered_clump();
  const std::string page = clump_html(clump, {}, Execution(1));
  const test::Rows errors = {{"error of the clump", "length", "% of equivalent radius"},
                             {"rms distance from scan to clump", "0.5", "12.5"},
                             {"largest distance from scan to clump", "0.75", "18.8"}};
  const test::Rows contacts = {{"first contact, % of equivalent radius", "mean error", "scatter"},
                               {"clump of 6 spheres", "-1.5", "2.25"}};
  const test::Rows masses = {
      {"error if taken for the grain's", "volume %", "centroid, % of radius", "inertia %"},
      {"union of the spheres", "3.5", "4.5", "5.5"},
      {"sum over the spheres", "6.5", "7.5", "8.5"}};
  const test::Rows log = test::cells_of_lines(clump_lines(clump));
  for (const test::Rows& rows : {errors, contacts, masses}) {
    EXPECT_EQ(test::table_named(page, rows[0][0]), rows);
    const auto found = std::find(log.begin(), log.end(), rows[0]);
    ASSERT_NE(found, log.end()) << rows[0][0];
    EXPECT_EQ(test::Rows(found, found + static_cast<std::ptrdiff_t>(rows.size())), rows);
  }
  const auto bodies = mass_rows({{"grain", mass_properties(clump.scan)},
                                 {"union of the spheres", clump.united.mass},
                                 {"sum over the spheres", clump.summed.mass}});
  EXPECT_EQ(test::table_named(page, bodies[0][0]), bodies);
  EXPECT_TRUE(holds(page, "Intersection over union of the volumes: 0.875."));
  EXPECT_EQ(clump_lines(clump)[0], "Scan        1234 vertices, 2464 faces, equivalent radius 4");
  EXPECT_EQ(clump_lines(clump)[1], "Clump       6 spheres, intersection over union 0.875");
}

TEST(ClumpReportNumbers, StandUnderTheirNamesInJsonAndCsv) {
  const ClumpResult clump = numbered_clump();
  const auto json = nlohmann::json::parse(clump_json(clump, {"grain.ply", "2026-11-26"}));
  EXPECT_EQ(json["source"], "grain.ply");
  EXPECT_EQ(json["date"], "2026-11-26");
  EXPECT_EQ(json["sphere_count"], 6);
  EXPECT_EQ(json["options"]["count"], 6);
  EXPECT_EQ(json["warnings"][0], clump.warnings[0].text());
  const std::pair<const char*, double> expected[] = {
      {"/input/vertices", 1234},
      {"/input/faces", 2464},
      {"/input/genus", 2},
      {"/input/equivalent_radius", 4.0},
      {"/rms_distance", 0.5},
      {"/rms_percent", 12.5},
      {"/largest_distance", 0.75},
      {"/largest_percent", 18.75},
      {"/intersection_over_union", 0.875},
      {"/smallest_radius", 0.03125},
      {"/first_contact/mean_percent", -1.5},
      {"/first_contact/scatter_percent", 2.25},
      {"/union/volume_error_percent", 3.5},
      {"/union/centroid_error_percent", 4.5},
      {"/union/inertia_error_percent", 5.5},
      {"/sum/volume_error_percent", 6.5},
      {"/sum/centroid_error_percent", 7.5},
      {"/sum/inertia_error_percent", 8.5},
      {"/grain/volume", mass_properties(clump.scan).volume},
      {"/union/mass/volume", clump.united.mass.volume},
      {"/sum/mass/volume", clump.summed.mass.volume},
      {"/union/mass/centroid/y", clump.united.mass.centroid.y()},
      {"/sum/mass/centroid/y", clump.summed.mass.centroid.y()},
      {"/stages/0/spheres", 2},
      {"/stages/0/rms_percent", 75.0},
      {"/stages/1/rms_percent", 31.25},
      {"/stages/2/spheres", 6}};
  for (const auto& [name, value] : expected) {
    EXPECT_EQ(json.at(nlohmann::json::json_pointer(name)).get<double>(), value) << name;
  }
  for (std::size_t k = 0; k < clump.spheres.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(json["spheres"][k][i], clump.spheres[k].centre[static_cast<Eigen::Index>(i)]);
    }
    EXPECT_EQ(json["spheres"][k][3], clump.spheres[k].radius);
  }
  test::expect_csv_is_flat_json(clump_csv(clump, {"grain.ply", ""}),
                                clump_json(clump, {"grain.ply", ""}));
}

// The allowed error is drawn where it is one of distances.
TEST(ClumpReportNumbers, CurveHasAPointPerStageAndTheAllowedDistance) {
  for (const auto& [measure, level] :
       {std::pair(ClumpError::Distance, 20.0), std::pair(ClumpError::Volume, 0.0)}) {
    ClumpResult clump = numbered_clump();
    clump.options.max_error_percent = 20.0;
    clump.options.error_measure = measure;
    EXPECT_TRUE(holds(clump_html(clump, {}, Execution(1)),
                      logarithmic_figure("number of spheres", "rms distance, %",
                                         {{2.0, 75.0}, {4.0, 31.25}, {6.0, 12.5}}, level)));
  }
}

TEST(ClumpReportNumbers, TellInHowManyPosesBodiesMet) {
  const std::vector<Sphere> ball = {{Vector3::Zero(), 1.0}};
  const auto pairs = ContactHeights(ball, 1.2, Execution(1)).distances(Execution(1)).size();
  EXPECT_TRUE(holds(clump_html(numbered_clump(), {}, Execution(1)),
                    " in " + std::to_string(pairs) + " pairs of poses."));
}

}  // namespace
}  // namespace wscvt
