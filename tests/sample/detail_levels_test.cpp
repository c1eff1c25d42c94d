// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/detail_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_table.h"

namespace wscvt {
namespace {

/// Eleven grains whose descriptors are off by 0, 1, ..., 10 times 50 / N + 0.05 %.
GrainTable table_with(double nodes) {
  GrainTable table;
  table.columns = {{"nodes", ""}, {"rms_distance", "length"}};
  const auto rows = list_descriptors(DetailedDescriptors());
  for (const std::string mesh : {"scan.", "remesh."}) {
    for (const DescriptorValue& one : rows) table.columns.push_back({mesh + one.key, one.unit});
  }
  table.values.setConstant(11, static_cast<Eigen::Index>(table.columns.size()), 4.0);
  for (Eigen::Index k = 0; k < 11; ++k) {
    table.grains.push_back(std::to_string(k));
    const double off = static_cast<double>(k) * (0.5 / nodes + 0.0005);
    table.values(k, 0) = nodes;
    table.values(k, 1) = 2.0 * off;  // of the radius 2
    for (std::size_t c = 2 + rows.size(); c < table.columns.size(); ++c) {
      table.values(k, static_cast<Eigen::Index>(c)) =
          k % 2 == 0 ? 4.0 + 4.0 * off : 4.0 - 4.0 * off;
    }
  }
  return table;
}

TEST(DetailLevels, TellMedianAnd90PercentAndTheNodesNeeded) {
  const DetailLevels levels =
      measure_levels({table_with(1000.0), table_with(100.0), table_with(300.0)}, 1.5);
  EXPECT_EQ(levels.nodes, (std::vector<double>{100.0, 300.0, 1000.0}));
  ASSERT_GT(levels.rows.size(), 30U);
  EXPECT_EQ(levels.rows[0].name, "rms_distance");
  for (const DescriptorLevels& row : levels.rows) {
    SCOPED_TRACE(row.name);
    EXPECT_NE(row.name, "ssk");  // zero is an ordinary value of it
    ASSERT_EQ(row.levels.size(), 3U);
    EXPECT_EQ(row.levels[0].count, 11U);
    // Of 11 grains the middle of the sixth is the median; 0.9 is 0.4 behind that of the tenth.
    EXPECT_NEAR(row.levels[0].median, 5.0 * 0.55, 1e-9);
    EXPECT_NEAR(row.levels[0].percent_90, 9.4 * 0.55, 1e-9);
    EXPECT_NEAR(row.levels[2].percent_90, 9.4 * 0.1, 1e-9);
    // Between 300 and 1000, at 9.4 times 0.21667 and 0.1, on logarithmic axes.
    const double slope = std::log(1.0 / 0.3) / std::log(0.65 / 3.0 / 0.1);
    EXPECT_EQ(row.nodes_needed, std::ceil(300.0 * std::pow(9.4 * 0.65 / 3.0 / 1.5, slope)));
  }
  EXPECT_EQ(measure_levels({table_with(100.0)}, 50.0).rows[3].nodes_needed, 100.0);
  EXPECT_TRUE(std::isnan(measure_levels({table_with(100.0)}, 0.1).rows[3].nodes_needed));
}

/// The table with two columns more.
GrainTable with_contacts(GrainTable table, double mean, double scatter) {
  table.columns.push_back({"contact_error_mean", "%"});
  table.columns.push_back({"contact_error_scatter", "%"});
  table.values.conservativeResize(Eigen::NoChange, table.values.cols() + 2);
  const Eigen::Index last = table.values.cols() - 1;
  for (Eigen::Index k = 0; k < table.values.rows(); ++k) {
    const double part = 0.1 * static_cast<double>(k);
    table.values(k, last - 1) = mean * part;
    table.values(k, last) = scatter * part;
  }
  return table;
}

TEST(DetailLevels, AMarkInPercentIsNoMarkOfDegrees) {
  GrainTable table = with_contacts(table_with(100.0), 3.0, 0.1);
  table.columns.back() = {"contact_normal_90", "degrees"};
  const DetailLevels levels = measure_levels({table}, 1.0);
  ASSERT_EQ(levels.rows[2].name, "contact_normal_90");
  EXPECT_EQ(levels.rows[2].unit, "degrees");
  EXPECT_TRUE(std::isnan(levels.rows[2].nodes_needed));
  EXPECT_EQ(levels.rows[1].unit, "%");
}

TEST(DetailLevels, ContactErrorsCountByTheirSize) {
  const DetailLevels levels = measure_levels(
      {with_contacts(table_with(100.0), -3.0, 5.0), with_contacts(table_with(400.0), -0.75, 1.25)},
      1.5);
  ASSERT_EQ(levels.rows[1].name, "contact_error_mean");
  ASSERT_EQ(levels.rows[2].name, "contact_error_scatter");
  EXPECT_NEAR(levels.rows[1].levels[0].median, 1.5, 1e-12);
  EXPECT_NEAR(levels.rows[1].levels[0].percent_90, 3.0 * 0.94, 1e-12);
  EXPECT_NEAR(levels.rows[2].levels[1].percent_90, 1.25 * 0.94, 1e-12);
  // Errors fall as 1 / N.
  EXPECT_EQ(levels.rows[1].nodes_needed, std::ceil(100.0 * 3.0 * 0.94 / 1.5));
  // With one table without them there is nothing to compare.
  const DetailLevels some =
      measure_levels({with_contacts(table_with(100.0), -3.0, 5.0), table_with(400.0)}, 1.5);
  EXPECT_EQ(some.rows.size(), levels.rows.size() - 2);
}

/// Grains of radius 1 with one rms distance.
GrainTable table_of_distance(double nodes, double percent) {
  GrainTable table;
  table.columns = {
      {"nodes", ""}, {"rms_distance", "length"}, {"scan.equivalent_diameter", "length"}};
  table.values = Eigen::RowVector3d(nodes, 0.01 * percent, 2.0).replicate(5, 1);
  table.grains.assign(5, "grain");
  return table;
}

TEST(DetailLevels, ErrorsThatRiseAgainNeedMoreNodes) {
  const auto needed = [](double first, double second, double third) {
    return measure_levels({table_of_distance(100.0, first), table_of_distance(400.0, second),
                           table_of_distance(1600.0, third)},
                          1.0)
        .rows.at(0)
        .nodes_needed;
  };
  // As 1 / N between the last two; rounded up.
  EXPECT_NEAR(needed(0.5, 2.0, 0.5), 800.0, 1.0);
  EXPECT_EQ(needed(2.0, 0.0, 0.0), 400.0);  // no line leads to 0
  EXPECT_TRUE(std::isnan(needed(0.5, 0.5, 2.0)));
}

TEST(DetailLevels, LeavesOutErrorsWithoutColumns) {
  GrainTable scans = table_with(100.0);
  for (GrainColumn& column : scans.columns) {
    if (column.name.rfind("remesh.", 0) == 0) column.name = "else." + column.name;
  }
  const DetailLevels levels = measure_levels({scans}, 1.0);
  ASSERT_EQ(levels.rows.size(), 1U);
  EXPECT_EQ(levels.rows[0].name, "rms_distance");
}

TEST(DetailLevels, RefusesTablesThatAreNone) {
  EXPECT_THROW(measure_levels({table_with(100.0), table_with(100.0)}, 1.0), Error);
  GrainTable without = table_with(100.0);
  without.columns[0].name = "N";
  EXPECT_THROW(measure_levels({without}, 1.0), Error);
  EXPECT_THROW(measure_levels({table_with(100.0)}, 0.0), Error);
}

}  // namespace
}  // namespace wscvt
