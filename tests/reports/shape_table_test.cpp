// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/shape_table.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

TEST(ShapeTable, RowsHaveTheColumnsOfTheHeader) {
  for (const auto& [what, scans, remeshes] :
       {std::tuple(Described::Both, true, true), std::tuple(Described::Scan, true, false),
        std::tuple(Described::Remesh, false, true)}) {
    GrainShape shape;
    if (scans) shape.scan.emplace().convexity = 0.25;
    if (remeshes) shape.remesh.emplace().convexity = 0.75;
    if (remeshes)
      shape.contacts = ScanContacts::Errors{
          {-0.5, 1.5}, {{0.1, 0.2}, {0.3, 0.4}, {5.0, 6.0}}, {{0.5, 0.6}, {0.7, 0.8}, {7.0, 8.0}}};
    RemeshResult result;
    result.mesh.points.resize(7);
    result.rms_distance = 0.125;
    result.scan_quality.edge_ratio.mean = 9.0;
    result.scan_quality.smallest_angle = 3.0;
    result.quality.edge_length.mean = 1.5;
    result.quality.edge_variation = 0.375;
    result.quality.edge_ratio.mean = 1.75;
    result.quality.smallest_angle = 33.0;
    result.input.vertices = 71;
    result.input.genus = 2;
    result.input.flap_area_fraction = 0.125;
    result.input.filled_area_fraction = 0.5;
    result.input.has_voxel_steps = true;
    const auto records = test::csv_records(
        shape_header({what, remeshes}) + shape_row("a, b.ply", "a, b.stl", result, shape) +
        failed_shape_row("c.ply", "It is broken.", {what, remeshes}));
    ASSERT_EQ(records.size(), 3U);
    const auto& names = records[0];
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    EXPECT_EQ(records[1].size(), names.size());
    EXPECT_EQ(records[2].size(), names.size());
    EXPECT_EQ(records[2][2], "It is broken.");
    const std::map<std::string, std::string> expected = {
        {"file", "a, b.stl"},
        {"nodes", "7"},
        {"rms_distance [length]", "0.125"},
        {"contact_error_mean [%]", "-0.5"},
        {"contact_error_scatter [%]", "1.5"},
        {"remesh.edge_length_mean [length]", "1.5"},
        {"remesh.edge_length_variation", "0.375"},
        {"remesh.edge_ratio_mean", "1.75"},
        {"remesh.smallest_angle [degrees]", "33"},
        {"scan.edge_ratio_mean", "9"},
        {"scan.smallest_angle [degrees]", "3"},
        {"scan.vertices", "71"},
        {"scan.genus", "2"},
        {"scan.repaired_area_fraction", "0.625"},
        {"scan.voxel_steps", "1"},
        {"contact_gap_median [%]", "0.1"},
        {"contact_gap_90_one_sided [%]", "0.6"},
        {"contact_place_90 [%]", "0.4"},
        {"contact_normal_90 [degrees]", "6"},
        {"contact_normal_median_one_sided [degrees]", "7"},
        {"scan.convexity", "0.25"},
        {"remesh.convexity", "0.75"}};
    std::size_t seen = 0;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto known = expected.find(names[k]);
      if (known == expected.end()) continue;
      EXPECT_EQ(records[1][k], known->second) << names[k];
      ++seen;
    }
    if (scans && remeshes) {
      EXPECT_EQ(seen, expected.size()) << "each name is a column";
    }
    EXPECT_EQ(shape_header({what, remeshes}).find(",scan.") != std::string::npos, scans);
    EXPECT_EQ(shape_header({what, remeshes}).find(",contact_error_") != std::string::npos,
              remeshes);
    EXPECT_EQ(shape_header({what, remeshes}).find(",remesh.") != std::string::npos, remeshes);
  }
}

/// A box 6 x 3 x 2 and a box 1 x 1 x 1, turned and moved.
RemeshResult two_boxes() {
  RemeshResult result;
  result.repaired_scan = test::transformed(test::box(6.0, 3.0, 2.0), test::random_rotation(6),
                                           Vector3(7.0, -4.0, 9.0));
  result.mesh = test::box(1.0, 1.0, 1.0);
  return result;
}

TEST(ShapeTable, DescribesEachMesh) {
  const RemeshResult result = two_boxes();
  const GrainShape both = describe_result(result, Described::Both, Execution(1));
  EXPECT_NEAR(both.scan->basic.volume, 36.0, 1e-9);
  EXPECT_NEAR(both.remesh->basic.volume, 1.0, 1e-9);
  EXPECT_FALSE(describe_result(result, Described::Scan, Execution(1)).remesh);
  EXPECT_FALSE(describe_result(result, Described::Remesh, Execution(1)).scan);
}

// The columns give the tensor of inertia of the box in its pose.
TEST(ShapeTable, HasThePrincipalFrame) {
  GrainShape shape;
  shape.scan.emplace().basic = describe_shape(two_boxes().repaired_scan, Execution(1));
  const auto records = test::csv_records(shape_header({Described::Scan, false}) +
                                         shape_row("a", "a.ply", RemeshResult(), shape));
  std::map<std::string, double> row;
  for (std::size_t k = 4; k < records[0].size(); ++k) {
    if (!records[1][k].empty()) row[records[0][k]] = std::stod(records[1][k]);
  }
  const Eigen::Matrix3d axes =
      Eigen::Quaterniond(row.at("scan.principal_axes_w"), row.at("scan.principal_axes_x"),
                         row.at("scan.principal_axes_y"), row.at("scan.principal_axes_z"))
          .toRotationMatrix();
  const Vector3 moments(row.at("scan.principal_moment_least [length^5]"),
                        row.at("scan.principal_moment_middle [length^5]"),
                        row.at("scan.principal_moment_greatest [length^5]"));
  // V / 12 times the sums of two squared edges.
  EXPECT_LT((moments - Vector3(3.0 * 13.0, 3.0 * 40.0, 3.0 * 45.0)).norm(), 1e-9);
  const Eigen::Matrix3d turn = test::random_rotation(6);
  const Eigen::Matrix3d expected = turn * moments.asDiagonal() * turn.transpose();
  EXPECT_LT((axes * moments.asDiagonal() * axes.transpose() - expected).norm(), 1e-9);
  EXPECT_NEAR(row.at("scan.centroid_x [length]"), 7.0, 1e-12);
  EXPECT_NEAR(row.at("scan.centroid_y [length]"), -4.0, 1e-12);
  EXPECT_NEAR(row.at("scan.centroid_z [length]"), 9.0, 1e-12);
}

TEST(ShapeTable, HasWhatTheVoxelsDidIfAskedFor) {
  const ShapeMeasures measures{Described::Scan, false, true};
  GrainShape known;
  known.scan.emplace();
  Resolution& resolution = known.resolution.emplace();
  resolution.voxel_size = 0.5;
  resolution.voxels_across = 21.0;
  for (const DescriptorValue& row : list_descriptors(*known.scan)) {
    ResolvedValue value;
    value.key = row.key;
    const bool is_area = row.key == "area";
    value.corrected = is_area ? 7.0 : std::nan("");
    value.low = is_area ? 6.0 : std::nan("");
    value.high = is_area ? 9.0 : std::nan("");
    resolution.rows.push_back(value);
  }
  GrainShape unknown;  // a scan whose voxels are not known has the columns too
  unknown.scan.emplace();
  unknown.resolution.emplace();
  const auto records =
      test::csv_records(shape_header(measures) + shape_row("a", "a.ply", RemeshResult(), known) +
                        shape_row("b", "b.ply", RemeshResult(), unknown));
  ASSERT_EQ(records.size(), 3U);
  std::map<std::string, std::size_t> places;
  for (std::size_t k = 0; k < records[0].size(); ++k) places[records[0][k]] = k;
  ASSERT_EQ(records[1].size(), records[0].size());
  ASSERT_EQ(records[2].size(), records[0].size());
  const std::map<std::string, std::string> expected = {
      {"resolution.voxel_size [length]", "0.5"},     {"resolution.voxels_across", "21"},
      {"resolution.area.corrected [length^2]", "7"}, {"resolution.area.low [length^2]", "6"},
      {"resolution.area.high [length^2]", "9"},      {"resolution.convexity.corrected", ""}};
  for (const auto& [name, value] : expected) {
    ASSERT_EQ(places.count(name), 1U) << name;
    EXPECT_EQ(records[1][places[name]], value) << name;
    EXPECT_EQ(records[2][places[name]], "") << name;
  }
  EXPECT_FALSE(test::holds(shape_header({Described::Remesh, false, true}), "resolution."));
}

}  // namespace
}  // namespace wscvt
