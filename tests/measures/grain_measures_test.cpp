// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/grain_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

/// A body of revolution about z and symmetric in z: a ball of radius 0.7 with a rim of radius 1
/// about its equator that overhangs it. Between 60 and 70 degrees from either pole a ray from the
/// centre leaves the ball, enters the rim and leaves it.
IndexedMesh overhanging() {
  constexpr int segments = 128;
  struct Ring {
    double radius;
    double polar_degrees;
  };
  std::vector<Ring> rings;
  for (int degrees = 5; degrees <= 70; degrees += 5) rings.push_back({0.7, double(degrees)});
  for (int degrees = 60; degrees <= 120; degrees += 5) rings.push_back({1.0, double(degrees)});
  for (int degrees = 110; degrees <= 175; degrees += 5) rings.push_back({0.7, double(degrees)});
  IndexedMesh mesh;
  mesh.points = {{0, 0, 0.7}, {0, 0, -0.7}};
  const auto at = [&](std::size_t ring, int segment) {
    return static_cast<std::int32_t>(2 + ring * segments +
                                     static_cast<std::size_t>((segment + segments) % segments));
  };
  for (const Ring& ring : rings) {
    const double theta = ring.polar_degrees * test::pi / 180.0;
    for (int k = 0; k < segments; ++k) {
      const double phi = 2.0 * test::pi * k / segments;
      mesh.points.emplace_back(ring.radius * std::sin(theta) * std::cos(phi),
                               ring.radius * std::sin(theta) * std::sin(phi),
                               ring.radius * std::cos(theta));
    }
  }
  for (int k = 0; k < segments; ++k) {
    mesh.triangles.push_back({0, at(0, k), at(0, k + 1)});
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      mesh.triangles.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
      mesh.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
    }
    mesh.triangles.push_back({1, at(rings.size() - 1, k + 1), at(rings.size() - 1, k)});
  }
  return mesh;
}

TEST(GrainMeasures, TellsAFoldByTheSolidAngleOfTheSheetsBeyondTheFirst) {
  const GrainMeasures measures =
      measure_grain({"rim", overhanging()}, std::nullopt, DetailedOptions(), Execution(1));
  const std::vector<std::string> sentences = remarks(measures);
  ASSERT_EQ(sentences.size(), 1U);
  const std::string before = "'rim' folds over itself: sheets beyond the first fill ";
  const std::size_t at = sentences[0].find(before);
  ASSERT_NE(at, std::string::npos) << sentences[0];
  // The two belts hold (cos 60 - cos 70) of the sphere's directions, and two sheets beyond the
  // first each. 128 segments cut the belts' rims by 1 - cos(pi / 128), 0.03 %.
  const double degree = test::pi / 180.0;
  const double directions = std::cos(60 * degree) - std::cos(70 * degree);
  const std::string text = sentences[0].substr(at + before.size());
  EXPECT_NEAR(std::stod(text), 100.0 * 2.0 * directions, 0.1);
  EXPECT_NE(text.find(" % of the solid angle"), std::string::npos) << text;
}

TEST(GrainMeasures, OfASphereHaveNothingToRemark) {
  const GrainMeasures measures =
      measure_grain({"ball", test::sphere(3)}, NamedMesh{"other", test::sphere(3)},
                    DetailedOptions(), Execution(1));
  EXPECT_TRUE(remarks(measures).empty());
  EXPECT_EQ(measures.grain.name, "ball");
  EXPECT_EQ(measures.reference->name, "other");
  // Samples inside the faces are rounded off their planes.
  EXPECT_NEAR(measures.distances->largest, 0.0, 1e-14);
  for (const DescriptorComparison& row : compare_descriptors(measures)) {
    // The smallest box is searched for, up to 1e-6.
    EXPECT_NEAR(row.value, row.reference, 1e-6) << row.key;
  }
}

TEST(GrainMeasures, TellOfPartsLeftOutAndCentroidsOutside) {
  const IndexedMesh crumb =
      test::transformed(test::sphere(2), 0.1 * Eigen::Matrix3d::Identity(), Vector3(5, 0, 0));
  const GrainMeasures measures = measure_grain(
      {"ring", test::torus(1.0, 0.2, 32)}, NamedMesh{"dusty", test::joined(test::sphere(3), crumb)},
      DetailedOptions(), Execution(1));
  const std::vector<std::string> sentences = remarks(measures);
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_NE(sentences[0].find("'ring' lies outside"), std::string::npos) << sentences[0];
  EXPECT_NE(sentences[1].find("2 parts of 'dusty'"), std::string::npos) << sentences[1];
}

TEST(GrainMeasures, RefuseAnOpenMeshByItsName) {
  IndexedMesh open = test::sphere(2);
  open.triangles.resize(open.triangles.size() / 2);  // more than is mended
  try {
    measure_grain({"whole", test::sphere(2)}, NamedMesh{"torn", open}, DetailedOptions(),
                  Execution(1));
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_EQ(std::string(error.what()).rfind("'torn': ", 0), 0U) << error.what();
  }
}

}  // namespace
}  // namespace wscvt
