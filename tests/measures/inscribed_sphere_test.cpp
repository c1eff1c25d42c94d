// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_steps.h"

namespace wscvt {
namespace {

/// The promise of the header, relative.
constexpr double tolerance = 1e-3;

TEST(InscribedSphere, CubeInAnyPose) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Vector3 shift(5, -6, 7);
    const InscribedSphere s = largest_inscribed_sphere(
        test::transformed(test::box(2, 2, 2), test::random_rotation(seed), shift), Execution(1));
    EXPECT_NEAR(s.radius, 1.0, tolerance);
    EXPECT_LE(s.radius, 1.0 + 1e-12);
    EXPECT_GE(s.upper_bound, 1.0 - 1e-12);
    EXPECT_LT((s.centre - shift).norm(), 2.0 * tolerance);
  }
}

TEST(InscribedSphere, RegularTetrahedron) {
  const InscribedSphere s = largest_inscribed_sphere(test::tetrahedron(1.0), Execution(1));
  EXPECT_NEAR(s.radius * std::sqrt(24.0), 1.0, tolerance);
  EXPECT_LE(s.upper_bound * std::sqrt(24.0), 1.0 + 2.0 * tolerance);
}

TEST(InscribedSphere, EllipsoidTouchesAtItsShortestAxis) {
  const InscribedSphere s =
      largest_inscribed_sphere(test::scaled(test::sphere(3), {0.5, 0.7, 1.0}), Execution(1));
  EXPECT_NEAR(s.radius, 0.5, 0.005);  // and chords of 0.16: 0.003
  EXPECT_LT(s.centre.norm(), 0.05);
}

TEST(InscribedSphere, FindsTheLargerOfTwoChambers) {
  // Two cubes of edge 1 and 1.2 joined by a thin bar: one mesh after another, overlapping.
  IndexedMesh mesh = test::box(1, 1, 1);
  const IndexedMesh larger =
      test::transformed(test::box(1.2, 1.2, 1.2), Eigen::Matrix3d::Identity(), {3, 0.1, 0.2});
  const auto offset = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), larger.points.begin(), larger.points.end());
  for (const Triangle& t : larger.triangles) {
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  const InscribedSphere s = largest_inscribed_sphere(mesh, Execution(1));
  EXPECT_NEAR(s.radius, 0.6, 0.6 * tolerance);
  EXPECT_LT((s.centre - Vector3(3, 0.1, 0.2)).norm(), 2.0 * tolerance);
}

/// The far end of a ball on a ray from the origin, which lies in the ball.
double far_end(const Vector3& direction, const Vector3& centre, double radius) {
  const double along = direction.dot(centre);
  return along + std::sqrt(along * along - centre.squaredNorm() + radius * radius);
}

// Balls of radius 1 and 1.03 whose centres are 0.8 apart: in the smaller one is a deepest place
// too, and the larger one lies within its reach. A spike moves the middle of the box into the
// smaller one, where the search begins; mirrored, it begins in the larger one.
TEST(InscribedSphere, FindsTheLargerOfTwoChambersThatOverlap) {
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(side);
    const Vector3 small(-0.37, 0.0, 0.0);
    const Vector3 large(0.43, 0.0, 0.0);
    IndexedMesh mesh = test::sphere(5);
    for (Vector3& p : mesh.points) {
      const Vector3 u = p.normalized();
      const double cosine = std::max(0.0, side * u.x());
      const double spike = 2.6 * std::pow(cosine, 60);
      p = u * std::max({far_end(u, small, 1.0), far_end(u, large, 1.03), spike});
    }
    const InscribedSphere s = largest_inscribed_sphere(
        test::transformed(mesh, test::random_rotation(5), {1, 2, 3}), Execution(1));
    EXPECT_NEAR(s.radius, 1.03, 0.005);  // chords of 0.04 take 2e-4, the spike's foot nothing
    EXPECT_LE(s.radius, s.upper_bound);
    EXPECT_LE(s.upper_bound, s.radius * (1.0 + 2.0 * tolerance));
  }
}

TEST(InscribedSphere, OfAPlateEndsAfterFiftyThousandDistances) {
  // Any point of the middle plane will do, and the bound would take 1e10 cells over it.
  std::vector<double> progress;
  const Execution watching(1, [&](double fraction, const std::string&) {
    progress.push_back(fraction);
    return progress.size() < 20000;  // so that a search without an end is stopped
  });
  const InscribedSphere s = largest_inscribed_sphere(test::box(1, 1, 0.01), watching);
  EXPECT_NEAR(s.radius, 0.005, 1e-9);
  EXPECT_GT(s.upper_bound, (1.0 + tolerance) * s.radius);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_GT(progress.back(), 0.99);
}

TEST(InscribedSphere, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(2);
  const InscribedSphere one = largest_inscribed_sphere(mesh, Execution(1));
  const InscribedSphere three = largest_inscribed_sphere(mesh, Execution(3));
  EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
}

TEST(InscribedSphere, RefusesAMeshWithoutFaces) {
  EXPECT_ERROR(largest_inscribed_sphere(IndexedMesh(), Execution(1)), InvalidInput);
}

TEST(InscribedSphere, StopsWhenAskedTo) {
  const auto run = [](const IndexedMesh& mesh) {
    return [&mesh](const Execution& execution) { largest_inscribed_sphere(mesh, execution); };
  };
  const IndexedMesh small = test::lumpy(2);
  test::expect_to_be_stopped(run(small), "Fitting the inscribed sphere", 3);
  // While the tree of 20,480 faces is made, too.
  const IndexedMesh large = test::sphere(5);
  test::expect_to_be_stopped(run(large), "Measuring distances", 3);
}

}  // namespace
}  // namespace wscvt
