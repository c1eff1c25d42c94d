// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/grain_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

TEST(GrainMeasures, TellsAFoldByTheSolidAngleOfTheSheetsBeyondTheFirst) {
  const GrainMeasures measures = measure_grain({"rim", test::overhanging_rim(10)}, std::nullopt,
                                               DetailedOptions(), Execution(1));
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
