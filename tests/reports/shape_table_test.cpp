// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/shape_table.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "support/flat_json.h"

namespace wscvt {
namespace {

TEST(ShapeTable, RowsHaveTheColumnsOfTheHeader) {
  for (const auto& [what, scans, remeshes] :
       {std::tuple(Described::Both, true, true), std::tuple(Described::Scan, true, false),
        std::tuple(Described::Remesh, false, true)}) {
    GrainShape shape;
    if (scans) shape.scan.emplace().convexity = 0.25;
    if (remeshes) shape.remesh.emplace().convexity = 0.75;
    if (remeshes) shape.contacts = ContactError{-0.5, 1.5};
    RemeshResult result;
    result.mesh.points.resize(7);
    result.rms_distance = 0.125;
    const auto records = test::csv_records(
        shape_header({what, remeshes}) + shape_row("a, b.ply", "a, b.stl", result, shape) +
        failed_shape_row("c.ply", "It is broken.", {what, remeshes}));
    ASSERT_EQ(records.size(), 3U);
    const auto& names = records[0];
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    EXPECT_EQ(records[1].size(), names.size());
    EXPECT_EQ(records[2].size(), names.size());
    EXPECT_EQ(records[2][2], "It is broken.");
    const std::map<std::string, std::string> expected = {{"file", "a, b.stl"},
                                                         {"nodes", "7"},
                                                         {"rms_distance [length]", "0.125"},
                                                         {"contact_error_mean [%]", "-0.5"},
                                                         {"contact_error_scatter [%]", "1.5"},
                                                         {"scan.convexity", "0.25"},
                                                         {"remesh.convexity", "0.75"}};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto known = expected.find(names[k]);
      if (known == expected.end()) continue;
      EXPECT_EQ(records[1][k], known->second) << names[k];
    }
    EXPECT_EQ(shape_header({what, remeshes}).find(",scan.") != std::string::npos, scans);
    EXPECT_EQ(shape_header({what, remeshes}).find(",contact_error_") != std::string::npos,
              remeshes);
    EXPECT_EQ(shape_header({what, remeshes}).find(",remesh.") != std::string::npos, remeshes);
  }
}

}  // namespace
}  // namespace wscvt
