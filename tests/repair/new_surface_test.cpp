// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/new_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "grains/bent_grain.h"
#include "support/expect_error.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

std::vector<Vector3> ellipsoid_points(int count, const Vector3& offset) {
  const Ellipsoid ellipsoid(Vector3(1.3, 0.9, 0.7));
  std::vector<Vector3> points = random_directions(count, test::announced(5));
  for (Vector3& p : points) p = offset + ellipsoid.radius(p) * p;
  return points;
}

TEST(PointCloud, BecomesAClosedMeshOfItsVolume) {
  const Vector3 offset(3.0, -2.0, 5.0);
  const IndexedMesh mesh = mesh_of_points(ellipsoid_points(5000, offset));
  EXPECT_EQ(mesh.points.size(), 5000U);
  const CheckedMesh checked = check_mesh(mesh, {}, Execution(1));
  EXPECT_EQ(checked.report.genus, 0);
  // Random points leave gaps a few times the mean spacing: chords lose about 4 times 660/N %.
  EXPECT_NEAR(checked.report.volume / (4.0 / 3.0 * pi * 1.3 * 0.9 * 0.7), 1.0, 0.006);
  EXPECT_NEAR((checked.report.centroid - offset).norm(), 0.0, 0.005);
}

TEST(PointCloud, MergesEqualPointsAndDoesNotDependOnTheirOrder) {
  std::vector<Vector3> points = ellipsoid_points(500, Vector3::Zero());
  const IndexedMesh once = mesh_of_points(points);
  points.insert(points.end(), points.begin(), points.begin() + 100);
  std::reverse(points.begin(), points.end());
  const IndexedMesh again = mesh_of_points(points);
  EXPECT_EQ(once.points, again.points);
  EXPECT_EQ(once.triangles, again.triangles);
}

TEST(PointCloud, IsSeenFromTheCentreOfTheVolumeHoweverDenseThePointsAre) {
  // Nine in ten lie in a cap, which their mean is near: seen from there the others make needles. On
  // a sphere the triangulation seen from its centre is the convex hull, of largest volume.
  std::vector<Vector3> points = fibonacci_lattice(500);
  for (const Vector3& p : random_directions(45000, test::announced(7))) {
    if (p.z() > 0.8) points.push_back(p);
  }
  const IndexedMesh mesh = mesh_of_points(points);
  const SphereTriangulation hull(mesh.points);
  const auto sorted = [](std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  std::vector<Triangle> common;
  const std::vector<Triangle> its = sorted(mesh.triangles);
  const std::vector<Triangle> best = sorted(hull.triangles());
  std::set_intersection(its.begin(), its.end(), best.begin(), best.end(),
                        std::back_inserter(common));
  EXPECT_LT(its.size() - common.size(), its.size() / 100);
}

TEST(PointCloud, RefusesWhatIsNoBody) {
  EXPECT_ERROR(mesh_of_points({Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)}),
               InvalidInput);
  std::vector<Vector3> flat;
  for (const Vector3& p : fibonacci_lattice(50)) flat.emplace_back(p.x(), p.y(), 0.0);
  EXPECT_ERROR(mesh_of_points(flat), NumericalFailure);
  std::vector<Vector3> bad = ellipsoid_points(50, Vector3::Zero());
  bad[7].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_ERROR(mesh_of_points(bad), InvalidInput);
  // Whose volume leaves the range of a double: they ended the program.
  for (const double size : {1e-300, 1e-130, 1e80, 1e300}) {
    SCOPED_TRACE(size);
    std::vector<Vector3> points = ellipsoid_points(50, Vector3::Zero());
    for (Vector3& p : points) p *= size;
    EXPECT_ERROR(mesh_of_points(points), InvalidInput);
  }
}

TEST(PointCloud, ReportsAndCanBeCancelled) {
  std::vector<double> fractions;
  mesh_of_points(ellipsoid_points(30000, Vector3::Zero()),
                 Execution(1, [&](double fraction, const std::string&) {
                   fractions.push_back(fraction);
                   return true;
                 }));
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.size(), 8U);  // every 8,192 of the points, in two rounds
  for (const char* stage : {"Making a surface of the points", "Sorting the points"}) {
    test::expect_to_be_stopped(
        [](const Execution& execution) {
          mesh_of_points(ellipsoid_points(1000, Vector3::Zero()), execution);
        },
        stage, 1);
  }
}

}  // namespace

namespace {

ShrinkWrapOptions opening(double percent) {
  ShrinkWrapOptions options;
  options.opening_percent = percent;
  return options;
}

/// Closed, oriented outward, nothing to mend.
MeshCheckReport checked(const IndexedMesh& mesh) {
  const MeshCheckReport report = check_mesh(mesh, MeshCheckOptions(), Execution(1)).report;
  EXPECT_EQ(report.vertices, mesh.points.size());
  EXPECT_EQ(report.faces, mesh.triangles.size());
  EXPECT_EQ(report.reoriented_faces, 0U);
  EXPECT_GT(volume_of(mesh, Execution(1)), 0.0);
  return report;
}

TEST(Envelope, OfABallLiesOnIt) {
  const IndexedMesh ball = test::sphere(4);
  const double diagonal = 2.0 * std::sqrt(3.0);
  const IndexedMesh shrink_wrap = shrink_wrap_of(ball, opening(4.0), Execution(1));
  EXPECT_EQ(checked(shrink_wrap).genus, 0);
  // It stands off by a hundredth of the opening; the ball's own faces lie .0022 inside at most.
  const double offset = 0.01 * 0.04 * diagonal;
  for (const Vector3& p : shrink_wrap.points) EXPECT_NEAR(p.norm(), 1.0 + offset, 0.0025);
  // Faces as wide as the opening cut off up to .14^2 / 6 of the radius; a tenth of the opening
  // farther out, where the wrap is made, the volume would be 4 % larger.
  EXPECT_NEAR(volume_of(shrink_wrap, Execution(1)) / volume_of(ball, Execution(1)), 1.0, 0.01);
}

TEST(Envelope, OfPointsSeesNothingOfWhatLiesInside) {
  // Gaps between 2,562 points on a ball are .09 wide, the opening is .28.
  const IndexedMesh ball = test::sphere(4);
  IndexedMesh cloud = {ball.points, {}};
  const std::uint64_t seed = test::announced(20261122);
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5);
  for (int i = 0; i < 50; ++i) {
    cloud.points.emplace_back(coordinate(engine), coordinate(engine), coordinate(engine));
  }
  const IndexedMesh shrink_wrap = shrink_wrap_of(cloud, opening(8.0), Execution(1));
  const MeshCheckReport report = checked(shrink_wrap);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.components, 1U);
  // Faces as wide as the opening cut off up to .28^2 / 6 of the radius, of the volume three times
  // as much.
  EXPECT_NEAR(report.volume / volume_of(ball, Execution(1)), 1.0, 0.04);
  std::shuffle(cloud.points.begin(), cloud.points.end(), engine);
  EXPECT_EQ(shrink_wrap_of(cloud, opening(8.0), Execution(2)).points, shrink_wrap.points);
}

TEST(Envelope, LeavesOutFacesWithoutAPlaceOrAnArea) {
  const IndexedMesh ball = test::sphere(3);
  IndexedMesh damaged = ball;
  damaged.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  damaged.points.emplace_back(0.0, std::numeric_limits<double>::infinity(), 0.0);
  const auto lost = static_cast<std::int32_t>(ball.points.size());
  damaged.triangles.push_back({0, 1, lost});
  damaged.triangles.push_back({0, lost + 1, 1});
  damaged.triangles.push_back({2, 3, 3});
  const IndexedMesh shrink_wrap = shrink_wrap_of(damaged, opening(10.0), Execution(1));
  EXPECT_EQ(shrink_wrap.points, shrink_wrap_of(ball, opening(10.0), Execution(1)).points);
}

// Three points on a line but for rounding make a face that is not flat for exact arithmetic, whose
// normal is 0 in doubles. CGAL divided by it: the program ended by SIGFPE, or never.
TEST(Envelope, LeavesOutFacesWithoutANormal) {
  IndexedMesh slivers = test::sphere(3);
  std::mt19937_64 engine(test::announced(4));
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  std::uniform_real_distribution<double> part(0.1, 0.9);
  for (int k = 0; k < 400; ++k) {
    const Vector3 from(place(engine), place(engine), place(engine));
    const Vector3 to(place(engine), place(engine), place(engine));
    const auto first = static_cast<std::int32_t>(slivers.points.size());
    for (const Vector3& p : {from, to, Vector3(from + part(engine) * (to - from))}) {
      slivers.points.push_back(p);
    }
    slivers.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_GT(shrink_wrap_of(slivers, opening(6.0), Execution(1)).points.size(), 100U);
}

TEST(Envelope, ClosesTunnelsThatAreNarrowerAndKeepsWiderOnes) {
  // Drilled 0.4 wide, with a diagonal of about 3.46.
  const IndexedMesh drilled = test::ball_with_a_tunnel();
  EXPECT_EQ(checked(shrink_wrap_of(drilled, opening(20.0), Execution(1))).genus, 0);
  EXPECT_EQ(checked(shrink_wrap_of(drilled, opening(2.0), Execution(1))).genus, 1);
}

TEST(Envelope, ThatWentInThroughAHoleIsRefusedWithAnOpeningThatClosesIt) {
  const IndexedMesh ball = test::sphere(3);
  for (const double width : {0.5, 1.0}) {  // the diagonal is 3.5
    SCOPED_TRACE(width);
    IndexedMesh open = ball;
    open.triangles.clear();
    for (const Triangle& t : ball.triangles) {
      const Vector3& corner = ball.points[static_cast<std::size_t>(t[0])];
      if ((corner - Vector3::UnitZ()).norm() > 0.5 * width) open.triangles.push_back(t);
    }
    const std::string sentence = test::refusal(
        ErrorCode::InvalidInput, [&] { shrink_wrap_of(open, opening(5.0), Execution(1)); });
    EXPECT_TRUE(test::holds(sentence, "wider than 5 %"));
    const std::string before = "An opening of ";
    const std::size_t told = sentence.find(before);
    ASSERT_NE(told, std::string::npos) << sentence;
    const double larger = std::stod(sentence.substr(told + before.size()));
    const IndexedMesh closed = shrink_wrap_of(open, opening(larger), Execution(1));
    // A shell has some per cent of it. The wrap dips into the hole.
    EXPECT_NEAR(volume_of(closed, Execution(1)) / volume_of(ball, Execution(1)), 1.0, 0.1);
  }
  // Gaps between faces are no holes, though most of the area is missing.
  IndexedMesh sparse = ball;
  sparse.triangles.clear();
  for (std::size_t f = 0; f < ball.triangles.size(); f += 3) {
    sparse.triangles.push_back(ball.triangles[f]);
  }
  EXPECT_EQ(checked(shrink_wrap_of(sparse, opening(15.0), Execution(1))).genus, 0);
  // A sheet has no inside at any opening.
  IndexedMesh half = ball;
  half.triangles.clear();
  for (const Triangle& t : ball.triangles) {
    if (ball.points[static_cast<std::size_t>(t[0])].z() > 0.0) half.triangles.push_back(t);
  }
  const std::string sentence = test::refusal(
      ErrorCode::InvalidInput, [&] { shrink_wrap_of(half, opening(5.0), Execution(1)); });
  EXPECT_TRUE(test::holds(sentence, "Close the hole first"));
}

TEST(Envelope, StopsWhenAskedTo) {
  // Faces in blocks of 131,072, their tree in parts of 8,192, and once a step of the wrapping.
  const IndexedMesh ball = test::sphere(5);
  test::expect_to_be_stopped(
      [&](const Execution& execution) { shrink_wrap_of(ball, opening(10.0), execution); },
      "Wrapping the scan", 200);
}

TEST(Envelope, HasNoneOfTheFlawsOfTheScan) {
  // Every seventh face is gone, every fifth turned, one body inside, one half out of it.
  IndexedMesh flawed = test::joined(
      test::joined(test::sphere(3), test::scaled(test::sphere(2), Vector3(0.5, 0.5, 0.5))),
      test::transformed(test::box(1, 1, 1), Eigen::Matrix3d::Identity(), Vector3(0.8, 0.3, 0.0)));
  IndexedMesh soup;
  soup.points = flawed.points;
  for (std::size_t f = 0; f < flawed.triangles.size(); ++f) {
    if (f % 7 == 3) continue;
    soup.triangles.push_back(flawed.triangles[f]);
    if (f % 5 == 0) std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
  }
  EXPECT_ERROR(check_mesh(soup, MeshCheckOptions(), Execution(1)), InvalidInput);
  const IndexedMesh shrink_wrap = shrink_wrap_of(soup, opening(15.0), Execution(1));
  EXPECT_EQ(checked(shrink_wrap).genus, 0);
  EXPECT_EQ(checked(shrink_wrap).components, 1U);
}

TEST(Envelope, IsTheSameWhereverAndHoweverLargeTheScanIs) {
  const IndexedMesh grain = test::lumpy(3);
  // Powers of two and whole shifts leave the digits as they are.
  IndexedMesh moved = grain;
  for (Vector3& p : moved.points) p = 1024.0 * p;
  const IndexedMesh here = shrink_wrap_of(grain, opening(5.0), Execution(1));
  const IndexedMesh there = shrink_wrap_of(moved, opening(5.0), Execution(3));
  ASSERT_EQ(here.triangles, there.triangles);
  for (std::size_t i = 0; i < here.points.size(); ++i) {
    EXPECT_EQ(Vector3(1024.0 * here.points[i]), there.points[i]);
  }
}

TEST(Envelope, RefusesWhatItCannotWrap) {
  EXPECT_ERROR(shrink_wrap_of({}, opening(2.0), Execution(1)), InvalidInput);
  IndexedMesh wrong = test::sphere(1);
  wrong.triangles[3][1] = 1000;
  EXPECT_ERROR(shrink_wrap_of(wrong, opening(20.0), Execution(1)), InvalidInput);
  wrong = test::sphere(1);
  for (Vector3& p : wrong.points) p *= std::numeric_limits<double>::quiet_NaN();
  EXPECT_ERROR(shrink_wrap_of(wrong, opening(20.0), Execution(1)), InvalidInput);
  EXPECT_ERROR(shrink_wrap_of({wrong.points, {}}, opening(20.0), Execution(1)), InvalidInput);
  // An extent, but no area.
  const IndexedMesh needle = {{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(2, 0, 0)}, {{0, 1, 2}}};
  EXPECT_ERROR(shrink_wrap_of(needle, opening(20.0), Execution(1)), InvalidInput);
  EXPECT_ERROR(shrink_wrap_of(test::sphere(2), opening(0.0), Execution(1)), InvalidInput);
  EXPECT_ERROR(shrink_wrap_of(test::sphere(2), opening(0.9), Execution(1)), InvalidInput);
  EXPECT_ERROR(shrink_wrap_of(test::sphere(2), opening(51.0), Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
