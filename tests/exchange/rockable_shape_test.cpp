// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/rockable_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/execution.h"
#include "wscvt/measures/descriptors.h"

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
  const RockableShape made = rockable_shape("box", mesh, mass);
  const ReadShape shape = read_shape(made.text);
  EXPECT_EQ(shape.name, "box");
  EXPECT_EQ(shape.radius, made.rounding.radius);
  ASSERT_EQ(shape.vertices.size(), 8U);
  EXPECT_EQ(shape.faces.triangles, mesh.triangles);
  // Each edge once; of a closed surface of 12 triangles there are 18.
  EXPECT_EQ(shape.edges.size(), 18U);
  EXPECT_EQ(std::set(shape.edges.begin(), shape.edges.end()).size(), 18U);
  EXPECT_NEAR(shape.volume, 6.0, 1e-12);
  EXPECT_LT((shape.moments - Vector3(5.0 / 12.0, 10.0 / 12.0, 13.0 / 12.0)).norm(), 1e-12);
  EXPECT_LT(shape.centre.norm(), 1e-12);
  // The faces of the rounded box lie in the box' own, within the 1 % that corners may lose.
  for (std::size_t i = 0; i < 8; ++i) {
    const Vector3 faces = shape.vertices[i].cwiseAbs() + Vector3::Constant(shape.radius);
    EXPECT_LT((faces - Vector3(1.5, 1.0, 0.5)).norm(), 0.01 * shape.radius);
  }
  EXPECT_LT((shape.extent - Vector3(1.5, 1.0, 0.5)).norm(), 0.01 * shape.radius);
}

TEST(RockableShape, OfSeveralPartsKeepsThePlanesOfEachOfThem) {
  const Vector3 middle(3.0, 0.5, -0.25);
  IndexedMesh both = test::box(3, 2, 1);
  const IndexedMesh other = test::moved(test::box(1, 2, 3), 1.0, middle);
  both.points.insert(both.points.end(), other.points.begin(), other.points.end());
  for (Triangle t : other.triangles) both.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  const MassProperties mass = mass_properties(describe_shape(test::box(3, 2, 1), Execution(1)));
  const ReadShape shape = read_shape(rockable_shape("folder/two plain parts.shp", both, mass).text);
  EXPECT_EQ(shape.name, "two_plain_parts");
  EXPECT_EQ(shape.faces.triangles, both.triangles);
  ASSERT_EQ(shape.vertices.size(), 16U);
  EXPECT_EQ(std::set(shape.edges.begin(), shape.edges.end()).size(), 36U);
  for (std::size_t i = 0; i < 16; ++i) {
    const Vector3 at = shape.vertices[i] - (i < 8 ? Vector3::Zero() : middle);
    const Vector3 faces = at.cwiseAbs() + Vector3::Constant(shape.radius);
    const Vector3 planes = i < 8 ? Vector3(1.5, 1.0, 0.5) : Vector3(0.5, 1.0, 1.5);
    EXPECT_LT((faces - planes).norm(), 0.01 * shape.radius);
  }
}

/// Rounding a box takes (4 - pi) r^2 / 4 per length of its edges, but for the corners. At a place u
/// from the drawn-in edge a face is sqrt(r^2 + u^2) - r from the cylinder about it, at most
/// (sqrt(3) - 1) r in a corner.
TEST(RockableShape, TellsWhatRoundingABoxDoes) {
  const IndexedMesh mesh = test::box(3, 2, 1);
  const MassProperties mass = mass_properties(describe_shape(mesh, Execution(1)));
  const Rounding made = rockable_shape("box", mesh, mass).rounding;
  const double of_grain = std::cbrt(4.5 / test::pi);
  const double r = made.radius;
  EXPECT_NEAR(made.radius_percent, 100.0 * r / of_grain, 1e-12);
  EXPECT_NEAR(made.largest_percent * of_grain, 100.0 * (std::sqrt(3.0) - 1.0) * r, 2.0 * r);
  // To first order in the gap 10 % more than the closed form; corners and their 1 % are the rest.
  const double loss = 100.0 * (1.0 - test::pi / 4.0) * r * r * 24.0 / 6.0;
  EXPECT_NEAR(made.volume_percent, -loss, 0.3 * loss);
  double squares = 0.0;
  constexpr int steps = 1000;
  for (int i = 0; i < steps; ++i) {
    const double gap = std::hypot(r, r * (i + 0.5) / steps) - r;
    squares += gap * gap * r / steps;
  }
  // Of 5,000 samples some 500 lie near an edge.
  const double rms = std::sqrt(squares * 2.0 * 24.0 / 22.0);
  EXPECT_NEAR(made.rms_percent * of_grain, 100.0 * rms, 10.0 * rms);
}

/// Distances are means over the surface, however many vertices it has.
TEST(RockableShape, TellsTheSameOfABoxOfSmallTriangles) {
  const IndexedMesh mesh = test::box(3, 2, 1);
  const MassProperties mass = mass_properties(describe_shape(mesh, Execution(1)));
  const Rounding plain = rockable_shape("box", mesh, mass).rounding;
  const Rounding fine = rockable_shape("box", test::subdivided(mesh, 5), mass).rounding;
  ASSERT_EQ(fine.radius_percent, plain.radius_percent);
  // Both are sampled, with some 500 of 5,000 places near an edge.
  EXPECT_NEAR(fine.rms_percent / plain.rms_percent, 1.0, 0.1);
  // A gap counts along the face's normal: from an edge to the radius, the integral over s of
  // (r - s) times the cosine r / s.
  const double r = fine.radius;
  const double loss = 100.0 * 2.0 * (1.0 - std::asinh(1.0)) * r * r * 24.0 / 6.0;
  EXPECT_NEAR(fine.volume_percent / -loss, 1.0, 0.1);
}

/// The radius is the largest of those that err by at most 0.1 %: the finer the mesh of a ball, the
/// larger. A needle is rounded by the smallest.
TEST(RockableShape, ChoosesTheLargestRadiusOfSmallError) {
  const auto rounding = [](const IndexedMesh& mesh) {
    const MassProperties mass = mass_properties(describe_shape(mesh, Execution(1)));
    return rockable_shape("body", mesh, mass).rounding;
  };
  const Vector3 axes(1.3, 1.0, 0.8);
  EXPECT_EQ(rounding(test::scaled(test::sphere(3), axes)).radius_percent, 5.0);
  const Rounding box = rounding(test::box(3, 2, 1));
  EXPECT_LT(box.rms_percent, 0.1);
  EXPECT_GT(box.radius_percent, 0.1);
  EXPECT_LT(box.radius_percent, 5.0);
  // Two larger spheres would not fit into a plate.
  EXPECT_LT(rounding(test::box(30, 20, 0.05)).radius, 0.025);
  EXPECT_TRUE(rounding_lines({Rounding()}).empty());
  EXPECT_EQ(rounding_lines({{0.3, 3.0, 0.05, 0.5, -0.02}, Rounding(), {0.1, 1.0, 0.1, 0.4, 0.01}}),
            std::vector<std::string>{
                "Rounded for Rockable by 1 to 3 % of the equivalent radius: rms distance 0.1 % of "
                "it, largest 0.5 %, volume -0.02 to 0.01 %"});
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
    const ReadShape shape = read_shape(rockable_shape("octahedron", mesh, mass).text);
    Vector3 reach = Vector3::Constant(shape.radius);
    for (int k = 0; k < 3; ++k) reach[k] += shape.vertices[place[2 * k]][k];
    EXPECT_LT(shape.centre.norm(), 1e-12);
    EXPECT_LT((shape.extent - reach).norm(), 1e-12);
  }
}

TEST(RockableShape, RefusesABodyOutsideItsPrincipalFrame) {
  const IndexedMesh turned = test::transformed(test::box(3, 2, 1), test::random_rotation(1));
  const IndexedMesh moved =
      test::transformed(test::box(3, 2, 1), Eigen::Matrix3d::Identity(), {1, 0, 0});
  for (const IndexedMesh& mesh : {turned, moved}) {
    const MassProperties mass = mass_properties(describe_shape(mesh, Execution(1)));
    EXPECT_ERROR(rockable_shape("box", mesh, mass), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
