// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/clump_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/count_of.h"
#include "support/test_shapes.h"
#include "wscvt/base/text_format.h"

namespace wscvt {
namespace {

using test::count_of;

/// Of a grain without symmetry, off the origin, with a remesh beside it.
const ClumpResult& shown_clump() {
  static const ClumpResult clump = [] {
    const IndexedMesh scan =
        test::moved(test::transformed(test::lumpy(3), Vector3(1.3, 1.0, 0.7).asDiagonal()), 2.0,
                    {-30.0, 5.0, 120.0});
    ClumpOptions options;
    options.sphere_count = 6;
    options.compared_nodes = 150;
    ClumpResult made = make_clump(scan, options, Execution(1));
    made.warnings = {"A sentence with <signs>."};
    return made;
  }();
  return clump;
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ClumpReport, LinesFitIn80ColumnsAndHoldEachNumberOnce) {
  const ClumpResult& clump = shown_clump();
  std::string all;
  for (const std::string& line : clump_lines(clump)) {
    EXPECT_LE(line.size(), 80U) << line;
    all += line + "\n";
  }
  for (const MassProperties& mass :
       {mass_properties(clump.original), clump.united.mass, clump.summed.mass}) {
    std::vector<double> numbers = {mass.volume, mass.principal_axes.w(), mass.principal_axes.x(),
                                   mass.principal_axes.y(), mass.principal_axes.z()};
    for (int i = 0; i < 3; ++i) {
      numbers.push_back(mass.centroid[i]);
      numbers.push_back(mass.principal_moments[i]);
      for (int j = i; j < 3; ++j) numbers.push_back(mass.inertia_tensor(i, j));
    }
    for (const double number : numbers) EXPECT_TRUE(holds(all, format_number(number))) << all;
  }
  EXPECT_TRUE(holds(all, "6 spheres"));
  ClumpResult one = clump;
  one.spheres.resize(1);
  EXPECT_TRUE(holds(clump_lines(one)[1], "1 sphere,")) << clump_lines(one)[1];
}

TEST(ClumpReport, JsonHoldsTheResult) {
  const ClumpResult& clump = shown_clump();
  const nlohmann::json json = nlohmann::json::parse(clump_json(clump, {"grain.ply", "2026-11-26"}));
  EXPECT_EQ(json["source"], "grain.ply");
  EXPECT_EQ(json["sphere_count"], 6);
  EXPECT_EQ(json["options"]["spheres"], 6);
  EXPECT_EQ(json["options"]["remesh-nodes"], 150);
  const double radius = clump.equivalent_radius;
  EXPECT_EQ(json["rms_distance"], clump.rms_distance);
  EXPECT_DOUBLE_EQ(json["rms_percent"], 100.0 * clump.rms_distance / radius);
  EXPECT_DOUBLE_EQ(json["largest_percent"], 100.0 * clump.largest_distance / radius);
  EXPECT_EQ(json["intersection_over_union"], clump.intersection_over_union);
  EXPECT_EQ(json["first_contact"]["clump"]["scatter_percent"], clump.contact.scatter);
  EXPECT_EQ(json["first_contact"]["remesh"]["mean_percent"], clump.remesh_contact->mean);
  EXPECT_EQ(json["union"]["inertia_error_percent"], clump.united.error.inertia_percent);
  EXPECT_EQ(json["sum"]["volume_error_percent"], clump.summed.error.volume_percent);
  double smallest = clump.spheres[0].radius;
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(json["spheres"][k][1], clump.spheres[k].centre.y());
    EXPECT_EQ(json["spheres"][k][3], clump.spheres[k].radius);
    smallest = std::min(smallest, clump.spheres[k].radius);
  }
  EXPECT_EQ(json["smallest_radius"], smallest);
  EXPECT_EQ(json["stages"].back()["spheres"], 6);
  EXPECT_DOUBLE_EQ(json["stages"].back()["rms_percent"], json["rms_percent"]);
  EXPECT_EQ(json["warnings"][0], clump.warnings[0]);
}

TEST(ClumpReport, CsvHasAHeadingForEachValue) {
  std::istringstream lines(clump_csv(shown_clump(), {"grain.ply", ""}));
  std::string heading;
  std::string row;
  ASSERT_TRUE(std::getline(lines, heading) && std::getline(lines, row));
  EXPECT_EQ(count_of(heading, ","), count_of(row, ","));
  EXPECT_TRUE(holds(heading, "first_contact.remesh.mean_percent"));
  // Of clumps without a remesh the columns are the same.
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
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find(">nan"), std::string::npos);
  for (const double number :
       {clump.contact.mean, clump.contact.scatter, clump.remesh_contact->mean,
        clump.remesh_contact->scatter, clump.united.error.inertia_percent,
        clump.summed.error.volume_percent, clump.summed.error.centroid_percent,
        100.0 * clump.largest_distance / clump.equivalent_radius}) {
    EXPECT_TRUE(holds(page, "<td>" + format_number(number, 3) + "</td>")) << number;
  }
  EXPECT_TRUE(holds(page, format_number(clump.intersection_over_union, 4)));
  EXPECT_TRUE(holds(page, "<td>remesh of 150 nodes</td>"));
  EXPECT_EQ(page, clump_html(clump, {"/scans/<grain>.ply", "2026-11-26"}, Execution(2)));

  ClumpResult plain = clump;
  plain.remesh_contact.reset();
  plain.stages.resize(1);
  plain.warnings.clear();
  const std::string less = clump_html(plain, {}, Execution(1));
  EXPECT_TRUE(holds(less, "<title>Clump with 6 spheres"));
  EXPECT_EQ(count_of(less, "<svg"), 2U);
  EXPECT_FALSE(holds(less, "remesh of"));
  EXPECT_FALSE(holds(less, "A sentence"));
}

}  // namespace
}  // namespace wscvt
