// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/node_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/flat_json.h"
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
  EXPECT_NE(vtp.find("NumberOfPoints=\"" + std::to_string(nodes.mesh.points.size()) + "\""),
            std::string::npos);
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

namespace {

/// A shape file read by its published form, word for word.
struct ReadShape {
  std::string name;
  double radius = 0.0;
  std::vector<Vector3> vertices;
  std::vector<std::pair<int, int>> edges;
  IndexedMesh faces;
  Vector3 extent, centre, moments;
  double volume = 0.0;
};

ReadShape read_shape(const std::string& text) {
  ReadShape shape;
  std::istringstream words(text);
  const auto vector = [&] {
    Vector3 v;
    words >> v[0] >> v[1] >> v[2];
    return v;
  };
  std::string word;
  words >> word;
  EXPECT_EQ(word, "<");
  while (words >> word && word != ">") {
    std::size_t count = 0;
    if (word == "name") {
      words >> shape.name;
    } else if (word == "radius") {
      words >> shape.radius;
    } else if (word == "preCompDone") {
      words >> word;
      EXPECT_EQ(word, "y");
    } else if (word == "nv") {
      words >> count;
      for (; count > 0; --count) shape.vertices.push_back(vector());
    } else if (word == "ne") {
      words >> count;
      for (; count > 0; --count) {
        auto& edge = shape.edges.emplace_back();
        words >> edge.first >> edge.second;
      }
    } else if (word == "nf") {
      words >> count;
      for (; count > 0; --count) {
        int corners = 0;
        Triangle t{};
        words >> corners >> t[0] >> t[1] >> t[2];
        EXPECT_EQ(corners, 3);
        shape.faces.triangles.push_back(t);
      }
    } else if (word == "obb.extent") {
      shape.extent = vector();
    } else if (word == "obb.center") {
      shape.centre = vector();
    } else if (word == "volume") {
      words >> shape.volume;
    } else if (word == "I/m") {
      shape.moments = vector();
    } else if (word == "orientation") {
      words >> word >> word >> word >> word;
    } else {
      EXPECT_TRUE(word == "position" || word.rfind("obb.e", 0) == 0) << word;
      vector();
    }
  }
  EXPECT_EQ(word, ">");
  return shape;
}

TEST(RockableShape, HoldsTheBodyByItsPublishedForm) {
  const IndexedMesh mesh = test::box(3, 2, 1);  // in its principal frame
  const MassProperties mass = mass_properties(describe_shape(mesh, Execution(1)));
  const ReadShape shape = read_shape(rockable_shape("box", node_table(mesh), mass));
  EXPECT_EQ(shape.name, "box");
  EXPECT_NEAR(shape.radius, 0.01 * std::cbrt(4.5 / test::pi), 1e-12);
  ASSERT_EQ(shape.vertices.size(), 8U);
  EXPECT_EQ(shape.faces.triangles, mesh.triangles);
  // Each edge once; of a closed surface of 12 triangles there are 18.
  EXPECT_EQ(shape.edges.size(), 18U);
  EXPECT_EQ(std::set(shape.edges.begin(), shape.edges.end()).size(), 18U);
  EXPECT_NEAR(shape.volume, 6.0, 1e-12);
  EXPECT_LT((shape.moments - Vector3(5.0 / 12.0, 10.0 / 12.0, 13.0 / 12.0)).norm(), 1e-12);
  EXPECT_LT(shape.centre.norm(), 1e-12);
  // The rounded corner touches what the sharp one was: drawn in by the radius, along the normal.
  const NodeTable nodes = node_table(mesh);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_LT((shape.vertices[i] + shape.radius * nodes.normals[i] - mesh.points[i]).norm(), 1e-12);
    EXPECT_LE(((shape.vertices[i] - shape.centre).cwiseAbs() - shape.extent).maxCoeff(),
              1e-12 - shape.radius);
  }
}

TEST(RockableShape, ItsBoxHoldsEveryCorner) {
  // Each corner of an octahedron is alone on its side; each in turn is the last.
  const Vector3 axes(1.0, 0.8, 0.5);
  for (int first = 0; first < 6; ++first) {
    IndexedMesh mesh;
    mesh.points.resize(6);
    std::array<std::int32_t, 6> place{};  // of the corner 2 k + side
    for (int i = 0; i < 6; ++i) {
      const int corner = (first + i) % 6;
      place[static_cast<std::size_t>(corner)] = i;
      mesh.points[static_cast<std::size_t>(i)] =
          (corner % 2 == 0 ? 1.0 : -1.0) * axes[corner / 2] * Vector3::Unit(corner / 2);
    }
    for (std::size_t octant = 0; octant < 8; ++octant) {
      Triangle t = {place[octant & 1U], place[2 + (octant >> 1U & 1U)],
                    place[4 + (octant >> 2U & 1U)]};
      const auto turns = (octant & 1U) + (octant >> 1U & 1U) + (octant >> 2U & 1U);
      if (turns % 2 == 1) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
    const MassProperties mass = mass_properties(describe_shape(mesh, Execution(1)));
    const ReadShape shape = read_shape(rockable_shape("octahedron", node_table(mesh), mass));
    EXPECT_LT(shape.centre.norm(), 1e-12);
    EXPECT_LT((shape.extent - axes).norm(), 1e-12);
  }
}

TEST(RockableShape, RefusesABodyOutsideItsPrincipalFrame) {
  const IndexedMesh turned = test::transformed(test::box(3, 2, 1), test::random_rotation(1));
  const IndexedMesh moved =
      test::transformed(test::box(3, 2, 1), Eigen::Matrix3d::Identity(), {1, 0, 0});
  for (const IndexedMesh& mesh : {turned, moved}) {
    const MassProperties mass = mass_properties(describe_shape(mesh, Execution(1)));
    EXPECT_ERROR(rockable_shape("box", node_table(mesh), mass), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
