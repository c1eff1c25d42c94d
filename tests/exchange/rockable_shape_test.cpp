// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/rockable_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string>

#include "support/expect_error.h"
#include "support/test_shapes.h"

namespace wscvt {
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
