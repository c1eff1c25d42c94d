// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/carried_attributes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

/// A colour and a quality that are linear in the place, without symmetry.
double red_at(const Vector3& p) { return 120.0 + 31.0 * p.x() - 17.0 * p.y() + 11.0 * p.z(); }
double quality_at(const Vector3& p) { return -0.4 * p.x() + 2.5 * p.y() + 0.7 * p.z(); }
double label_at(const Vector3& p) { return p.z() - 0.3 * p.x() > 0.1 ? 70000.0 : -3.0; }

MeshAttributes attributes_of(const IndexedMesh& mesh) {
  MeshAttributes attributes;
  attributes.of_vertices = {{"red", ScalarType::Uint8, {}},
                            {"quality", ScalarType::Float64, {}},
                            {"label", ScalarType::Int32, {}}};
  attributes.of_faces = {{"part", ScalarType::Int32, {}}};
  for (const Vector3& p : mesh.points) {
    attributes.of_vertices[0].values.push_back(red_at(p));
    attributes.of_vertices[1].values.push_back(quality_at(p));
    attributes.of_vertices[2].values.push_back(label_at(p));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    attributes.of_faces[0].values.push_back(
        label_at((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0));
  }
  return attributes;
}

TEST(CarriedAttributes, LinearOnesComeOutAsOfTheNearestPointAndLabelsUnmixed) {
  const IndexedMesh scan = test::lumpy(4);
  const IndexedMesh mesh = test::lumpy(3);
  const MeshAttributes carried = carried_attributes(scan, attributes_of(scan), mesh);
  ASSERT_EQ(carried.of_vertices.size(), 3U);
  ASSERT_EQ(carried.of_faces.size(), 1U);
  EXPECT_EQ(carried.of_vertices[0].name, "red");
  EXPECT_EQ(carried.of_vertices[0].type, ScalarType::Uint8);
  double edge = 0.0;
  for (const auto& [a, b, c] : scan.triangles) {
    edge = std::max(edge, (scan.points[a] - scan.points[b]).norm());
  }
  // The nodes of `mesh` are vertices of `scan`, or lie within an edge of it; the slopes are
  // those of the two functions.
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_NEAR(carried.of_vertices[0].values[i], red_at(mesh.points[i]), 38.0 * edge);
    EXPECT_NEAR(carried.of_vertices[1].values[i], quality_at(mesh.points[i]), 2.7 * edge);
    const double label = carried.of_vertices[2].values[i];
    EXPECT_TRUE(label == 70000.0 || label == -3.0) << label;
    if (std::abs(mesh.points[i].z() - 0.3 * mesh.points[i].x() - 0.1) > 1.1 * edge) {
      EXPECT_EQ(label, label_at(mesh.points[i]));
    }
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const Vector3 middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0;
    if (std::abs(middle.z() - 0.3 * middle.x() - 0.1) < 3.0 * edge) continue;
    EXPECT_EQ(carried.of_faces[0].values[f], label_at(middle));
  }
}

TEST(CarriedAttributes, AreInterpolatedWithinATriangle) {
  IndexedMesh scan;
  scan.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {9, 9, 9}};
  scan.triangles = {{3, 3, 0}, {0, 1, 2}};  // the first has no area
  MeshAttributes own;
  own.of_vertices = {{"green", ScalarType::Uint8, {10, 50, 90, 7}},
                     {"phase", ScalarType::Uint8, {10, 50, 90, 7}}};
  own.of_faces = {{"part", ScalarType::Int32, {1, 2}}};
  IndexedMesh mesh;
  mesh.points = {{1, 2, 5}, {1, 2, -5}, {2.5, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const MeshAttributes carried = carried_attributes(scan, own, mesh);
  // By hand: weights 1/4, 1/4, 1/2 and 1/8, 5/8, 1/4.
  EXPECT_NEAR(carried.of_vertices[0].values[0], 60.0, 1e-12);
  EXPECT_NEAR(carried.of_vertices[0].values[1], 60.0, 1e-12);
  EXPECT_NEAR(carried.of_vertices[0].values[2], 55.0, 1e-12);
  EXPECT_EQ(carried.of_vertices[1].values, (std::vector<double>{90, 90, 50}));
  EXPECT_EQ(carried.of_faces[0].values, (std::vector<double>{2}));
}

TEST(CarriedAttributes, OfPointsAreThoseOfTheNearest) {
  IndexedMesh scan = test::lumpy(3);
  scan.triangles.clear();
  MeshAttributes own = attributes_of(scan);
  own.of_faces.clear();
  IndexedMesh mesh = scan;
  for (Vector3& p : mesh.points) p += Vector3(1e-4, -2e-4, 1e-4);
  EXPECT_EQ(carried_attributes(scan, own, mesh, Execution(3)).of_vertices[1].values,
            own.of_vertices[1].values);
}

TEST(CarriedAttributes, OfNoneAreNoneAndWrongNumbersAreRefused) {
  const IndexedMesh scan = test::lumpy(2);
  EXPECT_TRUE(carried_attributes(scan, MeshAttributes(), scan).empty());
  MeshAttributes own = attributes_of(scan);
  own.of_faces[0].values.pop_back();
  const std::string sentence =
      test::refusal(ErrorCode::InvalidInput, [&] { carried_attributes(scan, own, scan); });
  EXPECT_NE(sentence.find("\"part\""), std::string::npos) << sentence;
}

}  // namespace
}  // namespace wscvt
