// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/descriptor_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "test_shapes.h"
#include "wscvt/error.h"

namespace wscvt {
namespace {

TEST(DescriptorTable, KeysAreDistinctLowerCaseNames) {
  std::set<std::string> keys;
  for (const DescriptorValue& row : list_descriptors(ShapeDescriptors())) {
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;
    EXPECT_EQ(row.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
        << row.key;
    EXPECT_FALSE(row.label.empty());
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
    EXPECT_NEAR(row.error_percent, expected, 1e-9);
  }
}

TEST(DescriptorTable, NoPercentageWhereItSaysNothing) {
  const std::vector<DescriptorValue> a = {{"skew", "skew", "", 1e-9, false}};
  const std::vector<DescriptorValue> b = {{"skew", "skew", "", 0.1, false}};
  EXPECT_TRUE(std::isnan(compare_descriptors(a, b).front().error_percent));
}

TEST(DescriptorTable, RefusesListsOfDifferentKinds) {
  const std::vector<DescriptorValue> a = {{"one", "one", "", 1.0}};
  const std::vector<DescriptorValue> b = {{"two", "two", "", 1.0}};
  EXPECT_THROW(compare_descriptors(a, b), Error);
  EXPECT_THROW(compare_descriptors(a, {}), Error);
}

}  // namespace
}  // namespace wscvt
