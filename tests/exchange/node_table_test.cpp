// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/node_table.h"

#include <gtest/gtest.h>

#include <numeric>
#include <sstream>
#include <string>

#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

/// The numbers of an array of a VTP file, by its name.
std::vector<double> numbers_of(const std::string& vtp, const std::string& name) {
  const std::size_t head = vtp.find("Name=\"" + name + "\"");
  const std::size_t begin = vtp.find(">\n", head) + 2;
  std::istringstream text(vtp.substr(begin, vtp.find("</DataArray>", begin) - begin));
  std::vector<double> numbers;
  for (double number = 0.0; text >> number;) numbers.push_back(number);
  return numbers;
}

TEST(NodeTable, OfASphereHasRadialNormalsAndItsArea) {
  const IndexedMesh sphere = test::sphere(4);
  const NodeTable nodes = node_table(sphere);
  ASSERT_EQ(nodes.normals.size(), sphere.points.size());
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    EXPECT_NEAR(nodes.normals[i].norm(), 1.0, 1e-14);
    EXPECT_GT(nodes.normals[i].dot(sphere.points[i]), 0.999) << i;
    EXPECT_GT(nodes.areas[i], 0.0);
  }
  const double area =
      mesh_sums(sphere.points, sphere.triangles, Vector3::Zero(), Execution(1)).area();
  EXPECT_NEAR(std::accumulate(nodes.areas.begin(), nodes.areas.end(), 0.0), area, 1e-12);
}

TEST(NodeTable, CsvReadsBackToTheSameBits) {
  const NodeTable nodes = node_table(test::lumpy(2));
  const test::GermanNumbers german;
  const auto records = test::csv_records(nodes_csv(nodes));
  ASSERT_EQ(records.size(), nodes.mesh.points.size() + 1);
  EXPECT_EQ(records[0], (std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz", "area"}));
  for (std::size_t i = 0; i < nodes.mesh.points.size(); ++i) {
    const auto number = [&](std::size_t column) {
      std::istringstream text(records[i + 1][column]);
      text.imbue(std::locale::classic());
      double value = 0.0;
      text >> value;
      return value;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(number(k), nodes.mesh.points[i][static_cast<Eigen::Index>(k)]);
      EXPECT_EQ(number(3 + k), nodes.normals[i][static_cast<Eigen::Index>(k)]);
    }
    EXPECT_EQ(number(6), nodes.areas[i]);
  }
}

TEST(NodeTable, VtpHoldsTheMeshAndItsArrays) {
  const NodeTable nodes = node_table(test::lumpy(2));
  const std::string vtp = nodes_vtp(nodes);
  EXPECT_TRUE(
      test::holds(vtp, "NumberOfPoints=\"" + std::to_string(nodes.mesh.points.size()) + "\""));
  const std::vector<double> points = numbers_of(vtp, "Points");
  const std::vector<double> normals = numbers_of(vtp, "normal");
  const std::vector<double> areas = numbers_of(vtp, "area");
  ASSERT_EQ(points.size(), 3 * nodes.mesh.points.size());
  ASSERT_EQ(normals.size(), points.size());
  EXPECT_EQ(areas, nodes.areas);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i % 3);
    EXPECT_EQ(points[i], nodes.mesh.points[i / 3][k]);
    EXPECT_EQ(normals[i], nodes.normals[i / 3][k]);
  }
  const std::vector<double> corners = numbers_of(vtp, "connectivity");
  const std::vector<double> ends = numbers_of(vtp, "offsets");
  ASSERT_EQ(corners.size(), 3 * nodes.mesh.triangles.size());
  ASSERT_EQ(ends.size(), nodes.mesh.triangles.size());
  for (std::size_t f = 0; f < ends.size(); ++f) {
    EXPECT_EQ(ends[f], 3.0 * static_cast<double>(f + 1));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(corners[3 * f + k], nodes.mesh.triangles[f][k]);
    }
  }
}

}  // namespace
}  // namespace wscvt
