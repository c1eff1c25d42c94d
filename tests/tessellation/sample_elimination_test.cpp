// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/sample_elimination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {
namespace {

/// An ellipsoid, mapped by the sphere that it was.
MappedSurface ellipsoid(const Vector3& semi_axes) {
  const IndexedMesh sphere = test::sphere(5);
  return {test::scaled(sphere, semi_axes), sphere.points, Execution(1)};
}

double area_of(const MappedSurface& surface) {
  const IndexedMesh& mesh = surface.mesh();
  return mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1)).area();
}

/// Where seeds lie on the surface.
std::vector<Vector3> spread(const MappedSurface& surface, int count,
                            const std::vector<double>& densities = {}) {
  std::vector<Vector3> positions;
  for (const Vector3& seed : spread_seeds(surface, densities, count, Execution(1))) {
    EXPECT_NEAR(seed.norm(), 1.0, 1e-14);
    positions.push_back(surface.position(seed));
  }
  EXPECT_EQ(positions.size(), static_cast<std::size_t>(count));
  return positions;
}

/// The distance of neighbours in the densest packing of the plane.
double densest_spacing(const MappedSurface& surface, int count) {
  return 2.0 * std::sqrt(area_of(surface) / (2.0 * std::sqrt(3.0) * count));
}

// Yuksel (2015, figure 6) finds 0.7 to 0.75 of the densest spacing on a plane; places drawn at
// random have hundredths. A few hundred seeds on a body have some pairs below that.
constexpr double expected_spacing = 0.6;

TEST(SpreadSeeds, KeepTheirDistance) {
  const MappedSurface ball = ellipsoid({1.0, 1.0, 1.0});
  const std::vector<Vector3> seeds = spread(ball, 300);
  EXPECT_GT(test::smallest_distance(seeds), expected_spacing * densest_spacing(ball, 300));
  // And leave no hole: a disc around a hole's middle would be as large as one of a seed.
  for (const Vector3& p : ball.mesh().points) {
    double nearest = 2.0;
    for (const Vector3& seed : seeds) nearest = std::min(nearest, (p - seed).norm());
    ASSERT_LT(nearest, densest_spacing(ball, 300));
  }
}

TEST(SpreadSeeds, AreAsManyAtOneEndOfALongBodyAsAtTheOther) {
  const MappedSurface needle = ellipsoid({10.0, 1.0, 1.0});
  constexpr int count = 500;
  std::vector<Vector3> seeds = spread(needle, count);
  std::vector<std::pair<double, double>> faces;  // x of the middle and area
  const std::vector<Vector3>& p = needle.mesh().points;
  for (const Triangle& t : needle.mesh().triangles) {
    faces.emplace_back((p[t[0]].x() + p[t[1]].x() + p[t[2]].x()) / 3.0,
                       triangle_area(p[t[0]], p[t[1]], p[t[2]]));
  }
  std::sort(faces.begin(), faces.end());
  std::sort(seeds.begin(), seeds.end(),
            [](const Vector3& a, const Vector3& b) { return a.x() < b.x(); });
  const double whole = area_of(needle);
  double area = 0.0;
  std::size_t below = 0;
  for (const auto& [x, part] : faces) {
    area += part;
    while (below < seeds.size() && seeds[below].x() < x) ++below;
    // Half of what places drawn at random would miss by at worst, .87 sqrt(count) (Kolmogorov).
    ASSERT_NEAR(static_cast<double>(below), count * area / whole, 10.0) << x;
  }
}

TEST(SpreadSeeds, FollowDensities) {
  const MappedSurface ball = ellipsoid({1.0, 1.0, 1.0});
  std::vector<double> densities;
  for (const Vector3& p : ball.mesh().points) densities.push_back(p.z() > 0.0 ? 9.0 : 1.0);
  const std::vector<Vector3> seeds = spread(ball, 400, densities);
  std::vector<Vector3> upper;
  std::vector<Vector3> lower;
  for (const Vector3& p : seeds) (p.z() > 0.0 ? upper : lower).push_back(p);
  // Nine tenths, but for half a row at the equator, of 24 below and 72 above it.
  EXPECT_NEAR(static_cast<double>(upper.size()), 360.0, 15.0);
  // Each half has the spacing of its own density.
  EXPECT_GT(test::smallest_distance(upper), expected_spacing * densest_spacing(ball, 720));
  EXPECT_GT(test::smallest_distance(lower), expected_spacing * densest_spacing(ball, 80));
}

TEST(SpreadSeeds, OfTwoSheetsDoNotCrowdEachOther) {
  // Twenty times thinner than the seeds' spacing.
  const MappedSurface flake = ellipsoid({1.0, 1.0, 0.005});
  const std::vector<Vector3> seeds = spread(flake, 300);
  for (const double side : {1.0, -1.0}) {
    std::vector<Vector3> of_side;
    for (const Vector3& p : seeds) {
      if (side * p.z() > 0.0) of_side.push_back(p);
    }
    EXPECT_GT(test::smallest_distance(of_side), expected_spacing * densest_spacing(flake, 300));
  }
}

TEST(SpreadSeeds, SameBytesOnAnyNumberOfThreads) {
  const MappedSurface body = ellipsoid({3.0, 2.0, 1.0});
  EXPECT_EQ(spread_seeds(body, {}, 700, Execution(1)), spread_seeds(body, {}, 700, Execution(3)));
}

TEST(SpreadSeeds, AHandfulSurroundsTheCentre) {
  const MappedSurface body = ellipsoid({3.0, 2.0, 1.0});
  for (int count = 4; count <= 12; ++count) {
    EXPECT_NO_THROW(SphereTriangulation(spread_seeds(body, {}, count, Execution(1)))) << count;
  }
}

TEST(SpreadSeeds, RefuseNumbersThatDoNotFit) {
  const MappedSurface ball = ellipsoid({1.0, 1.0, 1.0});
  const auto refusal = [&](const std::vector<double>& densities, int count) {
    return test::refusal(ErrorCode::InvalidInput,
                         [&] { spread_seeds(ball, densities, count, Execution(1)); });
  };
  EXPECT_NE(refusal({}, 3).find("at least 4"), std::string::npos);
  EXPECT_NE(refusal({1.0, 2.0}, 50).find("give one each, or none"), std::string::npos);
}

}  // namespace
}  // namespace wscvt
