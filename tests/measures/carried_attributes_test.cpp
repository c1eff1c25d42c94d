// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/carried_attributes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"
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
                     {"alpha", ScalarType::Uint8, {10, 50, 90, 7}},
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
  EXPECT_EQ(carried.of_vertices[1].values, carried.of_vertices[0].values) << "a colour too";
  EXPECT_EQ(carried.of_vertices[2].values, (std::vector<double>{90, 90, 50}));
  EXPECT_EQ(carried.of_faces[0].values, (std::vector<double>{2}));
}

/// 7 x 5 pixels whose colours are linear in their places.
TexturePicture linear_picture() {
  TexturePicture picture{7, 5, {}};
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 7; ++column) {
      picture.colours.push_back(static_cast<std::uint8_t>(10 + 30 * column));
      picture.colours.push_back(static_cast<std::uint8_t>(200 - 40 * row));
      picture.colours.push_back(static_cast<std::uint8_t>(5 + 11 * column + 7 * row));
    }
  }
  return picture;
}

/// Red, green and blue of vertex i.
std::array<double, 3> colour_of(const MeshAttributes& attributes, std::size_t i) {
  EXPECT_EQ(attributes.of_vertices.size(), 3U);
  std::array<double, 3> colour{};
  const std::array<const char*, 3> names{"red", "green", "blue"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(attributes.of_vertices[k].name, names[k]);
    EXPECT_EQ(attributes.of_vertices[k].type, ScalarType::Uint8);
    colour[k] = attributes.of_vertices[k].values[i];
  }
  return colour;
}

/// Two triangles of a square from (0, 0) to (1, 1), whose places in the picture are those of the
/// square, moved.
MeshAttributes square_texture(const IndexedMesh& square, const MeshTexture::Place& moved) {
  MeshAttributes own;
  own.texture.pictures = {linear_picture()};
  own.texture.picture_of_face = {0, 0};
  for (const Triangle& t : square.triangles) {
    std::array<MeshTexture::Place, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = square.points[t[k]].head<2>().cast<float>() + moved;
    }
    own.texture.corners.push_back(corners);
  }
  return own;
}

const IndexedMesh unit_square{
    {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(1, 1, 0), Vector3(0, 1, 0)},
    {{0, 1, 2}, {0, 2, 3}}};

TEST(CarriedAttributes, ATextureIsItsPicturesColourAtTheNearestPoint) {
  // Between the middles of the outermost pixels; u from the left, v from the bottom.
  const IndexedMesh mesh{{Vector3(0.21, 0.83, 0.4), Vector3(0.77, 0.16, -1.0),
                          Vector3(0.5, 0.5, 0.0), Vector3(0.0, 1.0, 0.0), Vector3(1.0, 0.0, 0.0)},
                         {}};
  for (const MeshTexture::Place& moved :
       {MeshTexture::Place(0, 0), MeshTexture::Place(3, -2), MeshTexture::Place(-1, 5)}) {
    const MeshAttributes carried =
        carried_attributes(unit_square, square_texture(unit_square, moved), mesh);
    for (std::size_t i = 0; i < 3; ++i) {
      const double column = 7.0 * mesh.points[i].x() - 0.5;
      const double row = 5.0 * (1.0 - mesh.points[i].y()) - 0.5;
      const std::array<double, 3> colour = colour_of(carried, i);
      // Places are single numbers of up to 6.
      const double tolerance = 210.0 * 1e-6;
      EXPECT_NEAR(colour[0], 10.0 + 30.0 * column, tolerance) << moved.transpose();
      EXPECT_NEAR(colour[1], 200.0 - 40.0 * row, tolerance);
      EXPECT_NEAR(colour[2], 5.0 + 11.0 * column + 7.0 * row, tolerance);
    }
  }
  // At the picture's corners the outermost pixels, not mixed with those of the other end.
  const MeshAttributes corners =
      carried_attributes(unit_square, square_texture(unit_square, MeshTexture::Place(0, 0)), mesh);
  EXPECT_EQ(colour_of(corners, 3), (std::array<double, 3>{10.0, 200.0, 5.0}));
  EXPECT_EQ(colour_of(corners, 4), (std::array<double, 3>{190.0, 40.0, 99.0}));
}

TEST(CarriedAttributes, EachFaceHasItsPictureAndOneWithoutIsWhite) {
  MeshAttributes own = square_texture(unit_square, MeshTexture::Place(0, 0));
  own.texture.pictures.push_back({1, 1, {12, 34, 56}});
  own.texture.pictures.push_back({});
  const IndexedMesh mesh{{Vector3(0.9, 0.1, 0.2), Vector3(0.1, 0.9, 0.2)}, {}};
  const std::array<double, 3> white{255.0, 255.0, 255.0};
  own.texture.picture_of_face = {1, -1};
  EXPECT_EQ(colour_of(carried_attributes(unit_square, own, mesh), 0),
            (std::array<double, 3>{12.0, 34.0, 56.0}));
  EXPECT_EQ(colour_of(carried_attributes(unit_square, own, mesh), 1), white);
  own.texture.picture_of_face = {2, 3};
  EXPECT_EQ(colour_of(carried_attributes(unit_square, own, mesh), 0), white);
  EXPECT_EQ(colour_of(carried_attributes(unit_square, own, mesh), 1), white);
  // Corners without places show the colour of a material, but no picture.
  for (auto& corners : own.texture.corners) corners.fill(MeshTexture::no_place());
  own.texture.picture_of_face = {1, 0};
  EXPECT_EQ(colour_of(carried_attributes(unit_square, own, mesh), 0),
            (std::array<double, 3>{12.0, 34.0, 56.0}));
  EXPECT_EQ(colour_of(carried_attributes(unit_square, own, mesh), 1), white);
}

TEST(CarriedAttributes, ColoursOfVerticesGoBeforeATextureAndNoPictureGivesNone) {
  MeshAttributes own = square_texture(unit_square, MeshTexture::Place(0, 0));
  own.of_vertices = {{"red", ScalarType::Uint8, {1, 2, 3, 4}}};
  const MeshAttributes coloured = carried_attributes(unit_square, own, unit_square);
  ASSERT_EQ(coloured.of_vertices.size(), 1U);
  EXPECT_EQ(coloured.of_vertices[0].values, own.of_vertices[0].values);
  EXPECT_TRUE(coloured.texture.empty());
  own.of_vertices.clear();
  own.texture.pictures = {TexturePicture()};
  EXPECT_TRUE(carried_attributes(unit_square, own, unit_square).empty());
  own.texture.pictures = {linear_picture()};
  own.texture.pictures[0].colours.pop_back();
  EXPECT_ERROR(carried_attributes(unit_square, own, unit_square), InvalidInput);
  own = square_texture(unit_square, MeshTexture::Place(0, 0));
  own.texture.corners.pop_back();
  EXPECT_ERROR(carried_attributes(unit_square, own, unit_square), InvalidInput);
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

TEST(CarriedAttributes, OfFacesAreThoseOfTheFaceNearestToTheCentroid) {
  const IndexedMesh scan = test::lumpy(3);
  MeshAttributes own;
  own.of_faces = {{"number", ScalarType::Int32, {}}};
  for (std::size_t f = 0; f < scan.triangles.size(); ++f) {
    own.of_faces[0].values.push_back(static_cast<double>(f));
  }
  // Its faces have many of the scan's about their centroids.
  const IndexedMesh mesh = test::transformed(test::lumpy(1), test::random_rotation(3));
  const std::vector<double> carried = carried_attributes(scan, own, mesh).of_faces[0].values;
  ASSERT_EQ(carried.size(), mesh.triangles.size());
  for (std::size_t f = 0; f < carried.size(); ++f) {
    const auto& [a, b, c] = mesh.triangles[f];
    const Vector3 middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0;
    const auto distance = [&](const Triangle& t) {
      const Vector3 &x = scan.points[t[0]], &y = scan.points[t[1]], &z = scan.points[t[2]];
      const Vector3 w = nearest_weights(x, y, z, middle);
      return (w[0] * x + w[1] * y + w[2] * z - middle).norm();
    };
    double least = 1e9;
    for (const Triangle& t : scan.triangles) least = std::min(least, distance(t));
    // Faces that share the nearest point are equally near.
    EXPECT_NEAR(distance(scan.triangles[static_cast<std::size_t>(carried[f])]), least, 1e-12) << f;
  }
}

TEST(CarriedAttributes, ACornerWithoutAValueDoesNotMatterWhereItHasNoWeight) {
  const IndexedMesh scan = test::box(1, 2, 3);
  MeshAttributes own = attributes_of(scan);
  own.of_vertices[1].values[0] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> carried = carried_attributes(scan, own, scan).of_vertices[1].values;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    EXPECT_EQ(std::isnan(carried[i]), i == 0) << i;
  }
}

TEST(CarriedAttributes, OfNoneAreNoneAndWrongNumbersAreRefused) {
  const IndexedMesh scan = test::lumpy(2);
  EXPECT_TRUE(carried_attributes(scan, MeshAttributes(), scan).empty());
  MeshAttributes own = attributes_of(scan);
  own.of_faces[0].values.pop_back();
  const std::string sentence =
      test::refusal(ErrorCode::InvalidInput, [&] { carried_attributes(scan, own, scan); });
  EXPECT_TRUE(test::holds(sentence, "\"part\""));
}

}  // namespace
}  // namespace wscvt
