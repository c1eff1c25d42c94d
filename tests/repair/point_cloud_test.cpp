// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/point_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "support/cancelled_runs.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
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
}  // namespace wscvt
