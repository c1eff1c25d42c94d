// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/descriptor_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_steps.h"

namespace wscvt {
namespace {

using test::holds;

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

// Settings of a grain are numbers in brackets.
TEST(DescriptorTable, WordsAreLabelsWithoutSettings) {
  DetailedDescriptors one;
  DetailedDescriptors other;
  one.roughness.cutoff = 0.25;
  other.roughness.cutoff = 0.75;
  const auto first = list_descriptors(one);
  const auto second = list_descriptors(other);
  std::size_t different = 0;
  std::size_t read_first = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const std::string words = descriptor_words(first[k].key);
    EXPECT_EQ(first[k].label.rfind(words.substr(0, words.size() - 1), 0), 0U) << words;
    if (first[k].label != second[k].label) {
      ++different;
      EXPECT_FALSE(holds(words, "cut-off 0"));
      EXPECT_LT(words.size(), first[k].label.size());
    }
    if (is_read_first(first[k].key)) ++read_first;
  }
  EXPECT_GT(different, 0U);
  EXPECT_EQ(read_first, 5U);
  EXPECT_EQ(descriptor_words("roundness_wadell"), "roundness (Wadell, by turn)");
  EXPECT_EQ(descriptor_words("sphericity_wadell"), "sphericity (Wadell)");
  EXPECT_EQ(descriptor_words("weight"), "");
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

TEST(DescriptorTable, EachValueStandsUnderItsOwnKey) {
  // Distinct numbers, so that none is told for another.
  DetailedDescriptors d;
  d.inertia_axes = {2.0, 3.0, 5.0};
  d.inertia_ratios = form_ratios(d.inertia_axes);
  d.box_axes = {7.0, 11.0, 17.0};
  d.box_ratios = form_ratios(d.box_axes);
  d.feret = {19.0, 6.5, 12.0, 8.0};
  d.mean_curvature_integral = 41.0;
  d.convexity = 0.91;
  d.inscribed_sphere.radius = 2.25;
  d.orientation.eigenvalues = Vector3(0.5, 0.3, 0.2);
  d.orientation.compactness = 0.41;
  d.orientation.flakiness = 0.42;
  d.orientation.rodness = 0.43;
  d.roundness.roundness = 0.51;
  d.roundness.smallest_radius = 0.52;
  d.has_roughness = true;
  d.roughness.sa = 0.61;
  d.roughness.sq = 0.62;
  d.roughness.ssk = 0.63;
  d.roughness.sku = 0.64;
  d.roughness.form_leak = 0.65;
  d.roughness.cutoff = 0.66;
  d.has_radius = true;
  d.printed_sdq = 0.71;
  std::map<std::string, double> values;
  for (const DescriptorValue& row : list_descriptors(d)) values[row.key] = row.value;
  const std::map<std::string, double> expected = {{"axis_s_inertia", 2.0},
                                                  {"axis_i_inertia", 3.0},
                                                  {"axis_l_inertia", 5.0},
                                                  {"aspect_ratio_inertia", 2.0 / 5.0},
                                                  {"zingg_elongation_inertia", 3.0 / 5.0},
                                                  {"zingg_flatness_inertia", 2.0 / 3.0},
                                                  {"kong_fonseca_elongation_inertia", 2.0 / 5.0},
                                                  {"kong_fonseca_flatness_inertia", 1.0 / 3.0},
                                                  {"axis_s_box", 7.0},
                                                  {"axis_i_box", 11.0},
                                                  {"axis_l_box", 17.0},
                                                  {"zingg_elongation_box", 11.0 / 17.0},
                                                  {"zingg_flatness_box", 7.0 / 11.0},
                                                  {"feret_max", d.feret.largest},
                                                  {"feret_min", d.feret.smallest},
                                                  {"nist_width", d.feret.width_across},
                                                  {"nist_thickness", d.feret.thickness_across},
                                                  {"mean_curvature_integral", 41.0},
                                                  {"convexity", 0.91},
                                                  {"inscribed_radius", 2.25},
                                                  {"orientation_f1", 0.5},
                                                  {"orientation_f2", 0.3},
                                                  {"orientation_f3", 0.2},
                                                  {"compactness", 0.41},
                                                  {"flakiness", 0.42},
                                                  {"rodness", 0.43},
                                                  {"roundness_wadell", 0.51},
                                                  {"roundness_smallest_radius", 0.52},
                                                  {"sa", 0.61},
                                                  {"sq", 0.62},
                                                  {"ssk", 0.63},
                                                  {"sku", 0.64},
                                                  {"sq_form_leak", 0.65},
                                                  {"roughness_cutoff", 0.66},
                                                  {"sdq_printed", 0.71}};
  for (const auto& [key, value] : expected) {
    ASSERT_EQ(values.count(key), 1U) << key;
    EXPECT_DOUBLE_EQ(values[key], value) << key;
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
  const std::vector<DescriptorValue> a = {{"skew", "skew", "", 0.5, false}};
  const std::vector<DescriptorValue> b = {{"skew", "skew", "", 0.1, false}};
  EXPECT_TRUE(std::isnan(compare_descriptors(a, b).front().error_percent));
}

// What is 0 for a ball has no scale of ratios, and has no percentage for other bodies either.
TEST(DescriptorTable, NoPercentageOfWhatABallHasNot) {
  DetailedDescriptors ball;
  ball.basic = describe_shape(test::sphere(2), Execution(1));
  ball.inertia_axes = ball.box_axes = {2.0, 2.0, 2.0};
  ball.inertia_ratios = ball.box_ratios = form_ratios(ball.box_axes);
  ball.orientation.eigenvalues = Vector3::Constant(1.0 / 3.0);
  ball.orientation.compactness = 1.0;
  std::set<std::string> zero;
  const auto of_ball = list_descriptors(ball);
  for (const std::string key : {"kong_fonseca_elongation_inertia", "kong_fonseca_flatness_inertia",
                                "kong_fonseca_elongation_box", "kong_fonseca_flatness_box", "ssk",
                                "sdq_clipped_fraction", "flakiness", "rodness"}) {
    zero.insert(key);
  }
  for (const DescriptorValue& row : of_ball) {
    EXPECT_EQ(row.on_ratio_scale, zero.count(row.key) == 0) << row.key;
    if (!row.on_ratio_scale && row.key != "ssk") {
      EXPECT_EQ(row.value, 0.0) << row.key;
    }
  }
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
  EXPECT_TRUE(holds(lines[0], "scan"));
  EXPECT_TRUE(holds(lines[0], "mesh"));
  EXPECT_EQ(lines[1].rfind("  volume, length^3 ", 0), 0U) << "the unit";
  EXPECT_TRUE(holds(lines[1], "+100.000"));
  EXPECT_LT(lines[0].find("scan"), lines[0].find("mesh"));
  EXPECT_LT(lines[1].find(" 0.1 "), lines[1].find(" 0.2 ")) << lines[1];
  EXPECT_EQ(lines[2].back(), '-');
  EXPECT_EQ(table_lines({{"one", "first", "", 1.5}}).back(), "  first       1.5");
}

TEST(DescriptorTable, TellsWhatTheVoxelsDid) {
  const std::vector<DescriptorValue> values = {{"area", "surface area", "length^2", 12.0},
                                               {"convexity", "convexity", "", 0.9},
                                               {"sq", "roughness Sq", "length", 0.5}};
  Resolution resolution;
  resolution.voxels_across = 23.0;
  const double none = std::nan("");
  resolution.rows = {{"area", 12.0, 0.0, 0.0, 10.0, 9.0, 11.0},
                     {"convexity", 0.9, 0.0, 0.0, 0.96, 0.95, 0.97},
                     {"sq", 0.5, 0.0, 0.0, none, none, none}};
  const auto rows = resolution_rows(values, resolution);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"Descriptor", "value", "corrected", "low", "high"}));
  EXPECT_EQ(rows[1], (std::vector<std::string>{"  surface area, length^2", "12", "10", "9", "11"}));
  EXPECT_EQ(rows[2], (std::vector<std::string>{"  convexity", "0.9", "0.96", "0.95", "0.97"}));
  EXPECT_EQ(rows[3],
            (std::vector<std::string>{"  roughness Sq, length", "0.5", "not resolved", "", ""}));
  // 12 is a fifth more than 10, and 0.9 a sixteenth less than 0.96.
  EXPECT_EQ(resolution_sentence(resolution),
            "The grain is 23 voxels across. Errors by the voxels, about: area +20.000 %, "
            "convexity -6.250 %. Not resolved: Sq.");
  resolution.has_voxels = false;
  EXPECT_EQ(resolution_sentence(resolution).rfind("Nothing is resolved", 0), 0U);
}

}  // namespace
}  // namespace wscvt
