// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/distance_bodies.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_steps.h"

namespace wscvt {
namespace {

FeretDiameters diameters(const IndexedMesh& mesh) {
  return feret_diameters(mesh, convex_hull(mesh.points), Execution(1));
}

TEST(FeretDiameters, OfAnEllipsoidAreItsAxes) {
  const Vector3 axes(0.5, 0.8, 1.3);
  const IndexedMesh mesh =
      test::transformed(test::scaled(test::sphere(4), axes),
                        test::random_rotation(test::announced(8)), {100, -200, 50});
  const FeretDiameters d = diameters(mesh);
  // Vertices lie on it; between them it is 1e-3 deep.
  EXPECT_NEAR(d.largest, 2.6, 3e-3);
  EXPECT_NEAR(d.smallest, 1.0, 3e-3);
  EXPECT_NEAR(d.width_across, 1.6, 5e-3);
  EXPECT_NEAR(d.thickness_across, 1.0, 5e-3);
}

TEST(FeretDiameters, OfABoxAreItsDiagonalAndItsShortestEdge) {
  for (const std::uint64_t pose : {1, 2, 3}) {
    SCOPED_TRACE(::testing::Message() << "pose " << pose);
    const IndexedMesh mesh =
        test::transformed(test::box(1, 2, 4), test::random_rotation(pose), {7, 8, 9});
    const FeretDiameters d = diameters(mesh);
    EXPECT_NEAR(d.largest, std::sqrt(21.0), 1e-9);
    EXPECT_NEAR(d.smallest, 1.0, 1e-9);  // across a face
    // Across the diagonal, in the planes through the middle: from an edge of length 1 to the other.
    EXPECT_LT(d.width_across, d.largest);
    EXPECT_GE(d.width_across, d.thickness_across);
    EXPECT_GE(d.thickness_across, 0.99);
  }
}

TEST(FeretDiameters, TheSmallestOfATetrahedronLiesBetweenTwoEdges) {
  const IndexedMesh mesh =
      test::transformed(test::tetrahedron(2.0), test::random_rotation(test::announced(4)));
  const FeretDiameters d = diameters(mesh);
  EXPECT_NEAR(d.largest, 2.0, 1e-9);
  EXPECT_NEAR(d.smallest, std::sqrt(2.0), 1e-3 * std::sqrt(2.0));
}

TEST(FeretDiameters, ChordsEndOnTheBodyAndNotOnItsShadow) {
  // A Z of three bars: its shadow along the longest diameter is wider than any chord across that.
  // Two spheres of radius 1 and a thin rod between: chords across the axis are those of one ball.
  const IndexedMesh mesh =
      test::joined(test::sphere(3), test::moved(test::sphere(3), 1.0, {6, 0, 0}));
  const FeretDiameters apart = diameters(mesh);
  EXPECT_NEAR(apart.largest, 8.0, 0.02);
  EXPECT_NEAR(apart.width_across, 2.0, 0.02);
  // Balls off the diameter's line to either side: the shadow is wider by their offset.
  IndexedMesh bent = test::joined(mesh, test::moved(test::sphere(3), 0.8, {2.0, 0.9, 0}));
  bent = test::joined(bent, test::moved(test::sphere(3), 0.8, {4.0, -0.9, 0}));
  const FeretDiameters d = diameters(bent);
  const double shadow = 2.0 * (0.9 + 0.8);
  EXPECT_LT(d.width_across, shadow - 0.5);
}

TEST(FeretDiameters, OfManyPointsAreThoseOfAll) {
  // More than 2,000 and more than 4,000 points; the two extreme ones are the last.
  IndexedMesh mesh = test::sphere(5);
  mesh.points[mesh.points.size() - 1] *= 1.05;
  mesh.points[mesh.points.size() - 2] = -mesh.points[mesh.points.size() - 1] / 1.05 * 1.05;
  const FeretDiameters d = diameters(mesh);
  EXPECT_NEAR(d.largest, 2.1, 1e-9);
  EXPECT_NEAR(d.smallest, 2.0, 2e-3);
}

// Of more points than every pair is tried of, so the ends are found by steps.
TEST(FeretDiameters, TheLargestOfAnUnevenBodyIsThatOfAllPairs) {
  for (const std::uint64_t seed : {2U, 3U}) {
    IndexedMesh mesh = test::transformed(test::sphere(5), test::random_rotation(seed));
    for (Vector3& p : mesh.points) {
      p.x() *= 1.3 + 0.1 * p.y();
      p.z() *= 0.9 - 0.1 * p.x();
    }
    const std::vector<Vector3> hull = convex_hull(mesh.points).points;
    ASSERT_GT(hull.size(), 4000U);
    double largest = 0.0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        largest = std::max(largest, (hull[i] - hull[k]).squaredNorm());
      }
    }
    const double found = diameters(mesh).largest / std::sqrt(largest);
    EXPECT_LE(found, 1.0 + 1e-15) << seed;
    // The best of the first 2,000 directions are up to 3.2e-4 short.
    EXPECT_GT(found, 1.0 - 2.5e-4) << seed;
  }
}

TEST(FeretDiameters, TheWidestSectionIsFoundBetweenThePlanes) {
  // Two pyramids of heights 1.3 and 2.7 on a rhomb with the diagonals 1.5 and 1.
  const std::vector<Vector3> corners = {{0, 0, -1.3}, {0, 0, 2.7},   {0.75, 0, 0},
                                        {0, 0.5, 0},  {-0.75, 0, 0}, {0, -0.5, 0}};
  IndexedMesh mesh = test::transformed(convex_hull(corners), test::random_rotation(7));
  const FeretDiameters d = diameters(mesh);
  EXPECT_NEAR(d.largest, 4.0, 1e-12);
  // The sections are 4 / 128 apart, and the best is moved by steps down to 1e-3 of that.
  EXPECT_NEAR(d.width_across, 1.5, 1.5 / 1.3 * 4.0 / 128.0 * 2e-3);
  // Points without a face do not count.
  const IndexedMesh hull = convex_hull(mesh.points);
  mesh.points.insert(mesh.points.begin(), Vector3(300.0, 200.0, 500.0));
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& corner : t) ++corner;
  }
  const FeretDiameters same = feret_diameters(mesh, hull, Execution(1));
  EXPECT_EQ(same.width_across, d.width_across);
  EXPECT_EQ(same.thickness_across, d.thickness_across);
}

// The narrowest width of a polyhedron is across a face or between two edges. All pairs are tried.
TEST(FeretDiameters, SmallestIsTheNarrowestOfAllFacesAndPairsOfEdges) {
  for (std::uint64_t k = 0; k < 12; ++k) {
    std::mt19937_64 random(test::announced(3100 + k));
    std::normal_distribution<double> normal;
    std::vector<Vector3> points;
    for (int i = 0; i < 70; ++i) {
      const Vector3 p(normal(random), normal(random), normal(random));
      points.push_back(Vector3(1.0, 0.9, 0.8).cwiseProduct(p.normalized()));
    }
    const IndexedMesh hull = convex_hull(points);
    std::vector<Vector3> edges;
    double narrowest = std::numeric_limits<double>::infinity();
    const auto try_across = [&](const Vector3& direction) {
      if (!(direction.norm() > 1e-9)) return;
      const Vector3 unit = direction.normalized();
      double low = unit.dot(points[0]);
      double high = low;
      for (const Vector3& p : points) {
        low = std::min(low, unit.dot(p));
        high = std::max(high, unit.dot(p));
      }
      narrowest = std::min(narrowest, high - low);
    };
    for (const Triangle& t : hull.triangles) {
      const Vector3 a = hull.points[t[1]] - hull.points[t[0]];
      const Vector3 b = hull.points[t[2]] - hull.points[t[1]];
      try_across(a.cross(b));
      edges.push_back(a);
    }
    for (const Triangle& t : hull.triangles) edges.push_back(hull.points[t[2]] - hull.points[t[1]]);
    for (const Vector3& a : edges) {
      for (const Vector3& b : edges) try_across(a.cross(b));
    }
    const double told = feret_diameters(hull, hull, Execution(1)).smallest;
    EXPECT_LT(std::abs(told / narrowest - 1.0), 1e-4) << k;
  }
}

TEST(FeretDiameters, RefuseWhatHasNone) {
  EXPECT_ERROR(feret_diameters(test::box(1, 1, 1), {{{0, 0, 0}}, {}}, Execution(1)), InvalidInput);
  EXPECT_ERROR(feret_diameters({}, test::box(1, 1, 1), Execution(1)), InvalidInput);
}

TEST(MeanCurvatureIntegral, OfABoxIsPiTimesTheSumOfItsEdges) {
  EXPECT_NEAR(mean_curvature_integral(test::box(1, 2, 4), Execution(1)), test::pi * 7.0, 1e-12);
  // However it is cut into faces, and in any pose.
  EXPECT_NEAR(mean_curvature_integral(
                  test::transformed(test::subdivided(test::box(1, 2, 4), 3),
                                    test::random_rotation(test::announced(6)), {50, 0, -9}),
                  Execution(2)),
              test::pi * 7.0, 1e-9);
}

TEST(MeanCurvatureIntegral, OfABallIsFourPiTimesItsRadius) {
  EXPECT_NEAR(
      mean_curvature_integral(test::moved(test::sphere(4), 3.0, Vector3::Zero()), Execution(1)),
      12.0 * test::pi, 0.01 * 12.0 * test::pi);
}

TEST(MeanCurvatureIntegral, OfATorusIsTwoPiSquaredTimesItsMajorRadius) {
  // Hollows count as negative: of the tube alone it would be larger on the outside only.
  EXPECT_NEAR(mean_curvature_integral(test::torus(3.0, 1.0, 96), Execution(1)),
              2.0 * test::pi * test::pi * 3.0, 0.01 * 60.0);
}

}  // namespace
}  // namespace wscvt
