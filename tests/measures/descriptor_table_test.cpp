// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/descriptor_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/form_axes.h"

namespace wscvt {
namespace {

void expect_distinct_names(const std::vector<DescriptorValue>& rows) {
  std::set<std::string> keys;
  std::set<std::string> labels;
  for (const DescriptorValue& row : rows) {
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;
    EXPECT_TRUE(labels.insert(row.label).second) << row.label;
    EXPECT_EQ(row.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
        << row.key;
    EXPECT_FALSE(row.label.empty());
  }
}

TEST(DescriptorTable, KeysAreDistinctLowerCaseNames) {
  expect_distinct_names(list_descriptors(ShapeDescriptors()));
  expect_distinct_names(list_descriptors(DetailedDescriptors()));
}

TEST(DescriptorTable, SameKeysForTheSameDescriptors) {
  DetailedDescriptors detailed;
  detailed.basic = describe_shape(test::box(1, 2, 3), Execution(1));
  const Vector3 axes = 2.0 * detailed.basic.inertia_semi_axes;
  detailed.inertia_axes = {axes[0], axes[1], axes[2]};
  detailed.inertia_ratios = form_ratios(detailed.inertia_axes);
  const auto all = list_descriptors(detailed);
  for (const DescriptorValue& row : list_descriptors(detailed.basic)) {
    const auto same = std::find_if(
        all.begin(), all.end(), [&](const DescriptorValue& other) { return other.key == row.key; });
    ASSERT_NE(same, all.end()) << row.key;
    EXPECT_EQ(same->label, row.label);
    EXPECT_EQ(same->unit, row.unit);
    EXPECT_DOUBLE_EQ(same->value, row.value);
  }
}

TEST(DescriptorTable, ComparesASphereWithOneTwiceAsLarge) {
  const Execution execution(1);
  const auto rows = compare_descriptors(
      list_descriptors(describe_shape(test::sphere(2), execution)),
      list_descriptors(describe_shape(test::scaled(test::sphere(2), {2, 2, 2}), execution)));
  for (const DescriptorComparison& row : rows) {
    SCOPED_TRACE(row.key);
    // The unit says how a descriptor grows.
    const double expected = row.unit == "length^3"   ? 700.0
                            : row.unit == "length^2" ? 300.0
                            : row.unit == "length"   ? 100.0
                                                     : 0.0;
    if (row.reference == 0.0) continue;  // no face of a ball is at the clip
    EXPECT_NEAR(row.error_percent, expected, 1e-9);
  }
}

TEST(DescriptorTable, NoPercentageWhereItSaysNothing) {
  const std::vector<DescriptorValue> a = {{"skew", "skew", "", 1e-9, false}};
  const std::vector<DescriptorValue> b = {{"skew", "skew", "", 0.1, false}};
  EXPECT_TRUE(std::isnan(compare_descriptors(a, b).front().error_percent));
}

TEST(DescriptorTable, NoPercentageAgainstAValueNearZero) {
  const std::vector<DescriptorValue> from = {{"axis", "axis", "length", 2.0},
                                             {"smooth", "smooth", "length", 0.0019},
                                             {"rough", "rough", "length", 0.0021},
                                             {"small", "small", "", 0.0009},
                                             {"ratio", "ratio", "", 0.0011}};
  std::vector<DescriptorValue> to = from;
  for (DescriptorValue& row : to) row.value *= 12.0;
  const std::vector<DescriptorComparison> rows = compare_descriptors(from, to);
  for (const std::size_t k : {0, 2, 4}) EXPECT_NEAR(rows[k].error_percent, 1100.0, 1e-9) << k;
  for (const std::size_t k : {1, 3}) EXPECT_TRUE(std::isnan(rows[k].error_percent)) << k;
  // A larger body of the same shape: the same rows say nothing.
  std::vector<DescriptorValue> large = from;
  for (std::size_t k = 0; k < 3; ++k) large[k].value *= 1e6;
  EXPECT_TRUE(std::isnan(compare_descriptors(large, large)[1].error_percent));
  EXPECT_EQ(compare_descriptors(large, large)[2].error_percent, 0.0);
}

TEST(DescriptorTable, RefusesListsOfDifferentKinds) {
  const std::vector<DescriptorValue> a = {{"one", "one", "", 1.0}};
  const std::vector<DescriptorValue> b = {{"two", "two", "", 1.0}};
  EXPECT_ERROR(compare_descriptors(a, b), InvalidInput);
  EXPECT_ERROR(compare_descriptors(a, {}), InvalidInput);
}

/// A row whose numbers need their last bit, and one that is not finite.
std::vector<DescriptorComparison> two_rows() {
  return {{"volume", "volume", "length^3", 0.1, 0.2, 100.0},
          {"ssk", "skewness, of heights", "", 1.0 / 3.0, std::nan(""), std::nan("")}};
}

TEST(DescriptorTable, LinesNameTheColumns) {
  const std::vector<std::string> lines = table_lines(two_rows(), {"scan", "mesh"});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_NE(lines[0].find("scan"), std::string::npos);
  EXPECT_NE(lines[0].find("mesh"), std::string::npos);
  EXPECT_NE(lines[1].find("+100.000"), std::string::npos);
  EXPECT_EQ(lines[2].back(), '-');
  EXPECT_EQ(table_lines({{"one", "first", "", 1.5}}).back(), "  first       1.5");
}

}  // namespace
}  // namespace wscvt
