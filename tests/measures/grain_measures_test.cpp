// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/grain_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

std::ptrdiff_t count_of(const std::vector<Sentence>& sentences, const std::string& text) {
  return std::count_if(sentences.begin(), sentences.end(),
                       [&](const std::string& one) { return one.find(text) != std::string::npos; });
}

TEST(GrainMeasures, TellsOverhangsByTheSolidAngleThatTheyCover) {
  const GrainMeasures measures = measure_grain({"rim", test::overhanging_rim(10)}, std::nullopt,
                                               DetailedOptions(), Execution(1));
  const std::vector<Sentence> sentences = remarks(measures);
  const std::string before = "'rim' is not star-shaped: overhangs cover ";
  const auto found = std::find_if(sentences.begin(), sentences.end(), [&](const std::string& one) {
    return one.find(before) != std::string::npos;
  });
  ASSERT_NE(found, sentences.end());
  const std::size_t at = found->text().find(before);
  // The two belts hold (cos 60 - cos 70) of the sphere's directions, and two sheets beyond the
  // first each. 128 segments cut the belts' rims by 1 - cos(pi / 128), 0.03 %.
  const double degree = test::pi / 180.0;
  const double directions = std::cos(60 * degree) - std::cos(70 * degree);
  const std::string text = found->text().substr(at + before.size());
  EXPECT_NEAR(std::stod(text), 100.0 * 2.0 * directions, 0.1);
  EXPECT_TRUE(test::holds(text, " % of the sphere"));
}

TEST(GrainMeasures, OfASphereHaveNothingToRemark) {
  const GrainMeasures measures =
      measure_grain({"ball", test::sphere(4)}, NamedMesh{"other", test::sphere(4)},
                    DetailedOptions(), Execution(1));
  EXPECT_TRUE(remarks(measures).empty());
  EXPECT_EQ(measures.grain.name, "ball");
  EXPECT_EQ(measures.reference->name, "other");
  // Samples inside the faces are rounded off their planes.
  EXPECT_NEAR(measures.distances->largest, 0.0, 1e-14);
  for (const DescriptorComparison& row : compare_descriptors(measures)) {
    EXPECT_EQ(row.value, row.reference) << row.key;
  }
}

TEST(GrainMeasures, DistancesAreFromTheGrainToTheReferenceAndBack) {
  // The grain's tip is far from the reference, and no place of the reference from the grain.
  IndexedMesh tip = test::sphere(3);
  tip.points[7] *= 1.3;
  const GrainMeasures measures = measure_grain({"tip", tip}, NamedMesh{"ball", test::sphere(3)},
                                               DetailedOptions(), Execution(1));
  EXPECT_NEAR(measures.distances->to_reference.maximum, 0.3, 1e-12);
  EXPECT_LT(measures.distances->from_reference.maximum, 0.15);
  // The tip makes the grain longer than the reference.
  for (const DescriptorComparison& row : compare_descriptors(measures)) {
    if (row.key != "volume" && row.key != "feret_max") continue;
    EXPECT_GT(row.value, row.reference) << row.key;
    EXPECT_GT(row.error_percent, 0.0) << row.key;
  }
}

TEST(GrainMeasures, TellSpikesAndCornersThatWereMerged) {
  const auto told = [](const IndexedMesh& mesh) {
    return remarks(measure_grain({"ball", mesh}, std::nullopt, DetailedOptions(), Execution(1)));
  };
  IndexedMesh spike = test::sphere(2);
  spike.points[5] *= 9.0;
  EXPECT_EQ(count_of(told(spike), "Check that it belongs to the grain."), 1);
  // Each face has its own corners, not quite in one place.
  IndexedMesh soup = test::unwelded(test::sphere(2));
  for (std::size_t k = 0; k < soup.points.size(); ++k) {
    soup.points[k] *= 1.0 + 1e-7 * std::sin(static_cast<double>(k));
  }
  const std::vector<Sentence> merged = told(soup);
  EXPECT_EQ(count_of(merged, "and were merged with them."), 1);
  EXPECT_EQ(count_of(merged, "Check that"), 0);
}

TEST(GrainMeasures, TellHolesThatWereFilled) {
  IndexedMesh open = test::sphere(4);
  open.triangles.erase(open.triangles.begin() + 5);
  const std::vector<Sentence> sentences =
      remarks(measure_grain({"ball", open}, std::nullopt, DetailedOptions(), Execution(1)));
  EXPECT_EQ(count_of(sentences, "This changed "), 1);
}

// The steps of single precision far from the origin look like those of voxels.
TEST(GrainMeasures, TellStepsOfSinglePrecisionFromThoseOfVoxels) {
  IndexedMesh ball = test::sphere(5);
  for (Vector3& p : ball.points) {
    p += Vector3(500000.3, 4200000.7, 812.0);
    p = p.cast<float>().cast<double>();
  }
  const std::vector<Sentence> told =
      remarks(measure_grain({"far", ball}, std::nullopt, DetailedOptions(), Execution(1)));
  EXPECT_EQ(count_of(told, "'far' is so far from the origin"), 1);
  EXPECT_EQ(count_of(told, "voxels"), 0);
}

TEST(GrainMeasures, TellOfPartsLeftOutAndCentroidsOutside) {
  const IndexedMesh crumb =
      test::transformed(test::sphere(2), 0.1 * Eigen::Matrix3d::Identity(), Vector3(5, 0, 0));
  const GrainMeasures measures = measure_grain(
      {"ring", test::torus(1.0, 0.2, 32)}, NamedMesh{"dusty", test::joined(test::sphere(4), crumb)},
      DetailedOptions(), Execution(1));
  const std::vector<Sentence> sentences = remarks(measures);
  EXPECT_EQ(count_of(sentences, "'ring' is not star-shaped: its volume centroid lies outside"), 1);
  EXPECT_EQ(count_of(sentences, "2 parts of 'dusty'"), 1);
}

TEST(GrainMeasures, TellWhatTheEdgesAreTooLongFor) {
  const auto told = [](const IndexedMesh& mesh) {
    return remarks(measure_grain({"body", mesh}, {}, DetailedOptions(), Execution(1)));
  };
  std::vector<Sentence> sentences = told(test::box(1, 1, 1));
  EXPECT_EQ(count_of(sentences, "'body' are too long to measure roundness"), 1);
  EXPECT_EQ(count_of(sentences, "the largest inscribed sphere has radius 0.5."), 1);
  EXPECT_EQ(count_of(sentences, "'body' are too long to measure roughness"), 1);
  // Sharp edges: resolved to a quarter of the balls, which are a fifth of the inscribed sphere.
  sentences = told(test::subdivided(test::box(1, 1, 1), 5));
  EXPECT_EQ(count_of(sentences, "roundness is below 0.05"), 1);
  EXPECT_EQ(count_of(sentences, "too long"), 0);
  // What is left of a smooth body is its form.
  const Eigen::Matrix3d stretch = Vector3(1.0, 2.0, 3.0).asDiagonal();
  sentences = told(test::transformed(test::sphere(5), stretch, Vector3::Zero()));
  EXPECT_EQ(count_of(sentences, "may be form"), 1);
}

TEST(GrainMeasures, TellWhatIsTrueOfBothGrainsOnce) {
  const auto told = [](const std::string& other, const IndexedMesh& mesh) {
    return remarks(measure_grain({"body", test::box(1, 1, 1)}, NamedMesh{other, mesh},
                                 DetailedOptions(), Execution(1)));
  };
  const std::string edges = "are too long to measure roughness";
  for (const char* other : {"other", "body"}) {
    const std::vector<Sentence> both = told(other, test::box(1, 1, 1));
    EXPECT_EQ(count_of(both, edges), 1);
    EXPECT_EQ(count_of(both, "The same is true of 'other'.") > 0, other[0] == 'o');
  }
  // Other numbers are other sentences.
  const std::vector<Sentence> two = told("other", test::box(1, 1, 2));
  EXPECT_EQ(count_of(two, edges), 2);
}

TEST(GrainMeasures, TellWhereSdqIsWhatItsClipSays) {
  const auto told = [](const IndexedMesh& mesh) {
    return remarks(measure_grain({"body", mesh}, {}, DetailedOptions(), Execution(1)));
  };
  EXPECT_EQ(
      count_of(told(test::overhanging_rim(10)), "Sdq (invariant form) of 'body' is not reliable"),
      1);
  EXPECT_EQ(count_of(told(test::lumpy(4)), "Walls"), 0);
}

TEST(GrainMeasures, TellOfTrianglesThatIntersect) {
  IndexedMesh dented = test::lumpy(4);
  const Vector3 place = dented.points[100];
  for (Vector3& p : dented.points) {
    if ((p - place).norm() < 0.25) p *= -0.6;
  }
  const auto told = [](const IndexedMesh& mesh) {
    return remarks(measure_grain({"body", mesh}, {}, DetailedOptions(), Execution(1)));
  };
  EXPECT_EQ(count_of(told(dented), "of triangles of 'body' intersect"), 1);
  EXPECT_EQ(count_of(told(test::lumpy(4)), "intersect"), 0);
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
