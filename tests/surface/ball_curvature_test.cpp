// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/ball_curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "support/distance_bodies.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

std::vector<PrincipalCurvatures> ball_curvatures(const SurfacePatches& patches,
                                                 const std::vector<BallCentre>& centres,
                                                 double radius, const Execution& execution) {
  return wscvt::ball_curvatures(patches, centres, std::vector<double>{radius}, execution).front();
}

/// Every patch, at its own centre.
std::vector<BallCentre> all_places(const SurfacePatches& patches) {
  std::vector<BallCentre> places;
  for (std::size_t i = 0; i < patches.patches.size(); ++i) {
    places.push_back({patches.patches[i].centre, static_cast<std::int32_t>(i)});
  }
  return places;
}

TEST(BallCurvature, OfASphereIsExactWhateverTheBallAndThePatches) {
  const IndexedMesh mesh = test::moved(test::sphere(4), 2.0, {10.0, -20.0, 5.0});
  for (const double share : {0.0, 0.2}) {
    for (const double radius : {0.4, 0.9}) {
      SCOPED_TRACE(::testing::Message() << "patch " << share << ", ball " << radius);
      const SurfacePatches patches = surface_patches(mesh, share * radius);
      double worst = 0.0;
      for (const PrincipalCurvatures& k :
           ball_curvatures(patches, all_places(patches), radius, Execution(1))) {
        worst = std::max({worst, std::abs(k.maximum - 0.5), std::abs(k.minimum - 0.5)});
      }
      // Edges of 0.14 bend by 4 degrees each; the mesh is not a sphere by that much.
      EXPECT_LT(worst, 0.5 * 0.02);
    }
  }
}

TEST(BallCurvature, OfACylinderIsThatOfItsCircleAndOfALine) {
  const IndexedMesh mesh = test::scan_of(
      test::turned(test::capsule(2.0, 0.5), test::random_rotation(test::announced(3))), 2.7, 0.1);
  const SurfacePatches patches = surface_patches(mesh, 0.0);
  const Eigen::Matrix3d turn = test::random_rotation(3);
  std::vector<BallCentre> places;
  for (const BallCentre& place : all_places(patches)) {
    if (std::abs((turn.transpose() * place.point).x()) < 1.5) places.push_back(place);
  }
  ASSERT_GT(places.size(), 500U);
  double maxima = 0.0;
  double minima = 0.0;
  for (const PrincipalCurvatures& k : ball_curvatures(patches, places, 0.4, Execution(1))) {
    // Facets of marching cubes lean by some degrees.
    EXPECT_NEAR(k.maximum, 2.0, 0.15);
    EXPECT_NEAR(k.minimum, 0.0, 0.15);
    maxima += k.maximum / static_cast<double>(places.size());
    minima += k.minimum / static_cast<double>(places.size());
  }
  EXPECT_NEAR(maxima, 2.0, 0.02);
  EXPECT_NEAR(minima, 0.0, 0.02);
}

TEST(BallCurvature, IsNegativeInHollows) {
  // The inside of a torus' ring: -1 / (3 - 1) along it, 1 across.
  const IndexedMesh mesh = test::torus(3.0, 1.0, 96);
  const SurfacePatches patches = surface_patches(mesh, 0.0);
  std::vector<BallCentre> inner;
  std::vector<BallCentre> outer;
  for (const BallCentre& place : all_places(patches)) {
    const double ring = std::hypot(place.point.x(), place.point.y());
    if (ring < 2.01) inner.push_back(place);
    if (ring > 3.99) outer.push_back(place);
  }
  ASSERT_FALSE(inner.empty());
  for (const PrincipalCurvatures& k : ball_curvatures(patches, inner, 0.3, Execution(1))) {
    EXPECT_NEAR(k.maximum, 1.0, 0.03);
    EXPECT_NEAR(k.minimum, -0.5, 0.03);
  }
  for (const PrincipalCurvatures& k : ball_curvatures(patches, outer, 0.3, Execution(1))) {
    EXPECT_NEAR(k.maximum, 1.0, 0.03);
    EXPECT_NEAR(k.minimum, 0.25, 0.03);
  }
}

TEST(BallCurvature, SpreadsTheTurnOfAnEdgeOverTheBall) {
  // Across the edge of a cube the normal turns by 90 degrees. The slope of the weighted line
  // through the step is, per unit turn of the tangential normal, linear in 1 / radius.
  const IndexedMesh mesh = test::subdivided(test::box(2.0, 2.0, 2.0), 5);
  const SurfacePatches patches = surface_patches(mesh, 0.0);
  std::int32_t at = -1;
  for (std::size_t i = 0; i < patches.patches.size(); ++i) {
    const Vector3& c = patches.patches[i].centre;
    if (c.z() == 1.0 && std::abs(c.y()) < 0.05 && c.x() > 0.95) at = static_cast<std::int32_t>(i);
  }
  ASSERT_GE(at, 0);
  const std::vector<BallCentre> place = {{{1.0, 0.0, 1.0}, at}};
  const double narrow = ball_curvatures(patches, place, 0.3, Execution(1))[0].maximum;
  const double wide = ball_curvatures(patches, place, 0.6, Execution(1))[0].maximum;
  EXPECT_GT(narrow, 1.0);
  EXPECT_NEAR(narrow / wide, 2.0, 0.1);
}

TEST(BallCurvature, ReadsOnlyWhatHangsTogetherInTheBall) {
  // A plate thinner than the ball: its other side is near, but only over the rim.
  const IndexedMesh mesh = test::subdivided(test::box(4.0, 4.0, 0.1), 5);
  const SurfacePatches patches = surface_patches(mesh, 0.0);
  std::vector<BallCentre> middle;
  for (const BallCentre& place : all_places(patches)) {
    if (std::abs(place.point.x()) < 0.5 && std::abs(place.point.y()) < 0.5) middle.push_back(place);
  }
  ASSERT_FALSE(middle.empty());
  for (const PrincipalCurvatures& k : ball_curvatures(patches, middle, 0.5, Execution(1))) {
    EXPECT_NEAR(k.maximum, 0.0, 1e-9);
    EXPECT_NEAR(k.minimum, 0.0, 1e-9);
  }
  // Bent along x, one side is hollow by as much as the other bulges: together they would be flat.
  IndexedMesh bent = mesh;
  for (Vector3& p : bent.points) p.z() += 0.25 * p.x() * p.x();
  const SurfacePatches of_bent = surface_patches(bent, 0.0);
  std::size_t looked_at = 0;
  for (const BallCentre& place : all_places(of_bent)) {
    if (std::abs(place.point.x()) > 0.1 || std::abs(place.point.y()) > 0.5) continue;
    ++looked_at;
    const bool is_upper = of_bent.patches[index(place.patch)].normal.z() > 0.0;
    const PrincipalCurvatures k = ball_curvatures(of_bent, {place}, 0.5, Execution(1)).front();
    // A parabola's curvature falls from its vertex on: by a tenth within the ball.
    EXPECT_NEAR(is_upper ? k.minimum : k.maximum, is_upper ? -0.5 : 0.5, 0.05);
    EXPECT_NEAR(is_upper ? k.maximum : k.minimum, 0.0, 1e-7);  // but for the fit's ridge
  }
  EXPECT_GT(looked_at, 20U);
}

TEST(BallCurvature, IsZeroWhereTheBallHoldsTooLittle) {
  const SurfacePatches patches = surface_patches(test::box(1.0, 1.0, 1.0), 0.0);
  for (const PrincipalCurvatures& k :
       ball_curvatures(patches, all_places(patches), 1e-3, Execution(1))) {
    EXPECT_EQ(k.maximum, 0.0);
    EXPECT_EQ(k.minimum, 0.0);
  }
}

TEST(BallCurvature, SameBitsOnAnyNumberOfThreads) {
  const SurfacePatches patches = surface_patches(test::lumpy(4), 0.05);
  const auto one = ball_curvatures(patches, all_places(patches), 0.2, Execution(1));
  const auto three = ball_curvatures(patches, all_places(patches), 0.2, Execution(3));
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].maximum, three[i].maximum);
    EXPECT_EQ(one[i].minimum, three[i].minimum);
  }
}

TEST(BallCurvature, RefusesARadiusThatIsNotPositive) {
  const SurfacePatches patches = surface_patches(test::box(1.0, 1.0, 1.0), 0.0);
  EXPECT_ERROR(ball_curvatures(patches, {}, 0.0, Execution(1)), InvalidInput);
  EXPECT_ERROR(ball_curvatures(patches, {}, std::nan(""), Execution(1)), InvalidInput);
}

TEST(SurfacePatches, AddUpToTheMesh) {
  const IndexedMesh mesh = test::lumpy(3);
  for (const double radius : {0.0, 0.1, 0.5}) {
    SCOPED_TRACE(radius);
    const SurfacePatches patches = surface_patches(mesh, radius);
    std::vector<double> areas(patches.patches.size(), 0.0);
    std::vector<Vector3> vectors(areas.size(), Vector3::Zero());
    std::vector<Vector3> moments(areas.size(), Vector3::Zero());
    ASSERT_EQ(patches.of_faces.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const Triangle& t = mesh.triangles[f];
      const Vector3& a = mesh.points[index(t[0])];
      const Vector3& b = mesh.points[index(t[1])];
      const Vector3& c = mesh.points[index(t[2])];
      const std::size_t patch = index(patches.of_faces[f]);
      areas[patch] += triangle_area(a, b, c);
      vectors[patch] += 0.5 * doubled_area_normal(a, b, c);
      moments[patch] += triangle_area(a, b, c) / 3.0 * (a + b + c);
    }
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const SurfacePatch& patch = patches.patches[i];
      EXPECT_NEAR(patch.area, areas[i], 1e-12);
      EXPECT_NEAR((patch.normal * patch.area - vectors[i]).norm(), 0.0, 1e-12);
      EXPECT_NEAR((patch.centre * patch.area - moments[i]).norm(), 0.0, 1e-12);
    }
  }
}

TEST(SurfacePatches, AreSmallAndConnected) {
  const IndexedMesh mesh = test::sphere(4);
  EXPECT_EQ(surface_patches(mesh, 0.0).patches.size(), mesh.triangles.size());
  const double radius = 0.2;
  const SurfacePatches patches = surface_patches(mesh, radius);
  // A ball of that radius about the first face cuts out 4 pi / 100 of area; the gaps between are
  // filled by smaller ones.
  EXPECT_LT(patches.patches.size(), 400U);
  EXPECT_GT(patches.patches.size(), 100U);
  std::vector<std::vector<Vector3>> centres(patches.patches.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    centres[index(patches.of_faces[f])].emplace_back(
        (mesh.points[index(t[0])] + mesh.points[index(t[1])] + mesh.points[index(t[2])]) / 3.0);
  }
  // One face of each, the first, has all others within the radius.
  for (const std::vector<Vector3>& of_patch : centres) {
    EXPECT_TRUE(std::any_of(of_patch.begin(), of_patch.end(), [&](const Vector3& first) {
      return std::all_of(of_patch.begin(), of_patch.end(),
                         [&](const Vector3& centre) { return (centre - first).norm() < radius; });
    }));
  }
  // Neighbours are mutual, each named once.
  for (std::size_t i = 0; i < patches.patches.size(); ++i) {
    const auto* begin = patches.neighbours.begin(i);
    const auto* end = patches.neighbours.end(i);
    EXPECT_GE(end - begin, 2);
    for (const auto* n = begin; n != end; ++n) {
      EXPECT_NE(index(*n), i);
      EXPECT_EQ(std::count(begin, end, *n), 1);
      const auto* back = patches.neighbours.begin(index(*n));
      EXPECT_EQ(std::count(back, patches.neighbours.end(index(*n)), static_cast<std::int32_t>(i)),
                1);
    }
  }
}

}  // namespace
}  // namespace wscvt
