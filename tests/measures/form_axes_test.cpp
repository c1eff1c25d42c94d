// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/direction_search.h"

namespace wscvt {
namespace {

TEST(FormAxes, BoxInAnyPoseHasItsOwnEdges) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const IndexedMesh mesh =
        test::transformed(test::box(1, 2, 3), test::random_rotation(seed), {10, -20, 30});
    const FormAxes axes = oriented_box_axes(mesh.points);
    // The search ends with steps of 1e-7.
    EXPECT_NEAR(axes.shortest, 1.0, 1e-6);
    EXPECT_NEAR(axes.intermediate, 2.0, 1e-6);
    EXPECT_NEAR(axes.longest, 3.0, 1e-6);
  }
}

TEST(FormAxes, TetrahedronStandsInACube) {
  const double edge = 2.0;
  const FormAxes axes = oriented_box_axes(
      test::transformed(test::tetrahedron(edge), test::random_rotation(test::announced(7))).points);
  EXPECT_NEAR(axes.shortest, edge / std::sqrt(2.0), 2e-3);
  EXPECT_NEAR(axes.longest, edge / std::sqrt(2.0), 2e-3);
}

/// A body without symmetry: points of a normal distribution, cubed so that few are extreme.
std::vector<Vector3> shard(std::uint64_t seed) {
  std::mt19937_64 engine(test::announced(seed));
  std::normal_distribution<double> normal;
  std::vector<Vector3> points;
  for (int i = 0; i < 60; ++i) {
    points.emplace_back(1.3 * normal(engine), normal(engine), 0.7 * normal(engine));
  }
  return points;
}

TEST(FormAxes, AreTheSameInEveryPose) {
  // The search's last step is 1e-6 radians.
  for (const std::uint64_t seed : {21, 22, 23}) {
    const std::vector<Vector3> points = shard(seed);
    const FormAxes first = oriented_box_axes(points);
    for (std::uint64_t pose = 1; pose <= 4; ++pose) {
      SCOPED_TRACE(::testing::Message() << "shard " << seed << ", pose " << pose);
      std::vector<Vector3> turned;
      const Eigen::Matrix3d turn = test::random_rotation(pose);
      for (const Vector3& p : points) turned.emplace_back(turn * p + Vector3(1, 2, 3));
      const FormAxes axes = oriented_box_axes(turned);
      EXPECT_NEAR(axes.shortest / first.shortest, 1.0, 1e-5);
      EXPECT_NEAR(axes.intermediate / first.intermediate, 1.0, 1e-5);
      EXPECT_NEAR(axes.longest / first.longest, 1.0, 1e-5);
    }
  }
}

TEST(FormAxes, NoBoxOfManyThousandIsSmallerByOnePerMille) {
  for (const std::uint64_t seed : {31, 32}) {
    SCOPED_TRACE(::testing::Message() << "shard " << seed);
    const std::vector<Vector3> points = shard(seed);
    const FormAxes axes = oriented_box_axes(points);
    const double volume = axes.shortest * axes.intermediate * axes.longest;
    double least = 1e9;
    for (std::uint64_t k = 0; k < 20000; ++k) {
      const Eigen::Matrix3d turn = test::random_rotation(1000 + k);
      double tried = 1.0;
      for (int axis = 0; axis < 3; ++axis) {
        double low = turn.row(axis).dot(points[0]);
        double high = low;
        for (const Vector3& p : points) {
          low = std::min(low, turn.row(axis).dot(p));
          high = std::max(high, turn.row(axis).dot(p));
        }
        tried *= high - low;
      }
      least = std::min(least, tried);
    }
    EXPECT_LT(volume, 1.001 * least);
  }
}

double box_volume(const std::vector<Vector3>& points, const Eigen::Matrix3d& turn) {
  Vector3 low = turn * points[0];
  Vector3 high = low;
  for (const Vector3& p : points) {
    const Vector3 turned = turn * p;
    low = low.cwiseMin(turned);
    high = high.cwiseMax(turned);
  }
  return (high - low).prod();
}

/// The smallest box that random turns find, of which the best are turned on by smaller steps.
double box_by_chance(const std::vector<Vector3>& points) {
  std::vector<std::pair<double, std::uint64_t>> starts;
  for (std::uint64_t k = 0; k < 600; ++k) {
    starts.emplace_back(box_volume(points, test::random_rotation(k)), k);
  }
  std::sort(starts.begin(), starts.end());
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  double least = starts.front().first;
  for (std::size_t s = 0; s < 20; ++s) {
    Eigen::Matrix3d turn = test::random_rotation(starts[s].second);
    double volume = starts[s].first;
    for (double step = 0.2; step > 1e-3; step *= 0.8) {
      for (int attempt = 0; attempt < 12; ++attempt) {
        const Vector3 axis = Vector3(normal(engine), normal(engine), normal(engine)).normalized();
        const Eigen::Matrix3d other = Eigen::AngleAxisd(step, axis).toRotationMatrix() * turn;
        const double tried = box_volume(points, other);
        if (!(tried < volume)) continue;
        volume = tried;
        turn = other;
      }
    }
    least = std::min(least, volume);
  }
  return least;
}

// The boxes about such points have many narrow valleys.
TEST(FormAxes, OfPointsOnAnEllipsoidAreOnePerMilleOfTheSmallestBox) {
  for (const std::uint64_t seed : {51, 52, 53}) {
    std::mt19937_64 engine(test::announced(seed));
    std::normal_distribution<double> normal;
    std::vector<Vector3> points;
    for (int k = 0; k < 400; ++k) {
      const double z = normal(engine);
      const double y = normal(engine);
      const Vector3 p = Vector3(normal(engine), y, z).normalized();
      points.push_back(p.cwiseProduct(Vector3(1.0, 0.8680916703, 0.8195079078)));
    }
    const FormAxes axes = oriented_box_axes(points);
    EXPECT_LT(axes.shortest * axes.intermediate * axes.longest, 1.001 * box_by_chance(points));
  }
}

// The boxes about a round plate are such a valley: each box of a flake took 19,000 trials.
TEST(Descend, DoesNotWalkAlongAValleyWhoseFloorIsNearlyLevel) {
  int trials = 0;
  const auto valley = [&trials](const Vector3& d) {
    ++trials;
    return 1.0 + 50.0 * d.z() * d.z() + 1e-4 * std::atan2(d.y(), d.x());
  };
  const Vector3 start = Vector3(0.8, 0.6, 0.05).normalized();
  const DirectionMinimum found = descend(valley, {start, valley(start)}, 4e-3, 1e-6);
  EXPECT_LT(std::abs(found.direction.z()), 1e-3);
  EXPECT_LT(trials, 1000);
}

// Otherwise a body in another pose could get another box.
TEST(ExtremePoints, AreTheFarthestInEachDirection) {
  // The point that is farthest in most directions is the last.
  std::mt19937_64 engine(test::announced(3));
  std::normal_distribution<double> normal;
  std::vector<Vector3> points;
  for (int k = 0; k < 400; ++k) points.emplace_back(normal(engine), normal(engine), normal(engine));
  points.emplace_back(9.0, 7.0, 8.0);
  constexpr int directions = 60;
  const std::vector<Vector3> extremes = extreme_points(points, directions, "", Execution(1));
  EXPECT_LT(extremes.size(), 60U);
  const auto reach = [](const std::vector<Vector3>& some, const Vector3& direction) {
    double farthest = -1e9;
    for (const Vector3& p : some) farthest = std::max(farthest, direction.dot(p));
    return farthest;
  };
  for (const Vector3& direction : fibonacci_lattice(directions)) {
    EXPECT_EQ(reach(extremes, direction), reach(points, direction));
  }
  points.resize(directions);
  EXPECT_EQ(extreme_points(points, directions, "", Execution(1)), points) << "few are all";
}

TEST(FrameOf, TurnsWithThePoints) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const std::vector<Vector3> points = shard(40 + seed);
    const Eigen::Matrix3d frame = frame_of(points);
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-12);
    const Eigen::Matrix3d turn = test::random_rotation(seed);
    std::vector<Vector3> turned;
    for (const Vector3& p : points) turned.emplace_back(turn * p + Vector3(3, 2, 1));
    EXPECT_LT((frame_of(turned) - turn * frame).norm(), 1e-9) << seed;
  }
}

TEST(FormAxes, EveryPointCountsWhereverItStands) {
  IndexedMesh body = test::transformed(test::scaled(test::icosahedron(), {1.0, 1.7, 0.6}),
                                       test::random_rotation(7), {1, 2, 3});
  body.points[4] += Vector3(0.1, 0.3, -0.2);
  const FormAxes axes = oriented_box_axes(body.points, Execution(1));
  for (std::size_t k = 0; k < body.points.size(); ++k) {
    std::rotate(body.points.begin(), body.points.begin() + 1, body.points.end());
    const FormAxes turned = oriented_box_axes(body.points, Execution(1));
    // Descents end within a millionth of a radian.
    EXPECT_NEAR(turned.longest, axes.longest, 1e-5);
    EXPECT_NEAR(turned.intermediate, axes.intermediate, 1e-5);
    EXPECT_NEAR(turned.shortest, axes.shortest, 1e-5);
  }
}

TEST(FormAxes, EllipsoidHasItsAxes) {
  // 162 points; above 2,000 the box is turned by extreme points only, tried with 2562.
  for (const int times : {2, 4}) {
    SCOPED_TRACE(times);
    const FormAxes axes =
        oriented_box_axes(test::transformed(test::scaled(test::sphere(times), {0.5, 0.75, 1.0}),
                                            test::random_rotation(test::announced(11)))
                              .points);
    EXPECT_NEAR(axes.shortest, 1.0, times == 2 ? 5e-2 : 5e-3);
    EXPECT_NEAR(axes.intermediate, 1.5, times == 2 ? 5e-2 : 5e-3);
    EXPECT_NEAR(axes.longest, 2.0, times == 2 ? 5e-2 : 5e-3);
  }
}

// The subdivided icosahedron has vertices on the axes, so that the ellipsoid's own box is one about
// them. The search, which looks only at points near the rim of the body as it is seen, must not end
// at a larger one: its last step of 1e-6 radians leaves less than 1e-7.
TEST(FormAxes, OfASmoothBodyIsNotLargerThanItsOwnBox) {
  for (const std::uint64_t seed : {31, 32, 33, 34}) {
    const IndexedMesh mesh = test::transformed(test::scaled(test::sphere(5), {0.9, 0.95, 1.0}),
                                               test::random_rotation(test::announced(seed)));
    const FormAxes axes = oriented_box_axes(mesh.points);
    EXPECT_LE(axes.shortest * axes.intermediate * axes.longest, 8.0 * 0.9 * 0.95 * (1.0 + 1e-7));
  }
}

TEST(FormAxes, NeverLargerThanTheAxisAlignedBox) {
  const IndexedMesh mesh = test::lumpy(2);
  Vector3 lower = mesh.points[0];
  Vector3 upper = lower;
  for (const Vector3& p : mesh.points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const FormAxes axes = oriented_box_axes(mesh.points);
  EXPECT_LE(axes.shortest * axes.intermediate * axes.longest, (upper - lower).prod());
  EXPECT_LE(axes.shortest, axes.intermediate);
  EXPECT_LE(axes.intermediate, axes.longest);
}

/// Points of a lattice in a pose: many lie on the edges and sides of their hull, which has more
/// than one triangulation.
std::vector<Vector3> turned_lattice() {
  std::vector<Vector3> points;
  const Eigen::Matrix3d turn = test::random_rotation(test::announced(3));
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 5; ++j) {
      for (int k = 0; k < 4; ++k) points.emplace_back(turn * Vector3(i, j, k));
    }
  }
  return points;
}

TEST(FormAxes, SameBitsEveryTimeWhereverMemoryLies) {
  for (const std::vector<Vector3>& points : {test::lumpy(2).points, turned_lattice()}) {
    const FormAxes first = oriented_box_axes(points);
    std::mt19937 random(5);
    std::vector<std::unique_ptr<char[]>> blocks(2000);
    for (int time = 0; time < 3; ++time) {
      // Free blocks of all sizes in no order: what is allocated next lies in none either.
      for (auto& block : blocks) {
        if (random() % 2 == 0) block = std::make_unique<char[]>(8 + random() % 600);
      }
      for (auto& block : blocks) {
        if (random() % 2 == 0) block.reset();
      }
      const FormAxes again = oriented_box_axes(points);
      EXPECT_EQ(first.shortest, again.shortest);
      EXPECT_EQ(first.intermediate, again.intermediate);
      EXPECT_EQ(first.longest, again.longest);
    }
  }
}

TEST(FormAxes, StopsWhenAskedTo) {
  // Once a direction in which the extreme point is looked for, and once a direction of an edge.
  const std::vector<Vector3> points = test::lumpy(5).points;
  test::expect_to_be_stopped(
      [&](const Execution& execution) { oriented_box_axes(points, execution); },
      "Turning the bounding box", 600 + 200);
}

TEST(FormAxes, RefusesWhatHasNoBox) {
  EXPECT_ERROR(oriented_box_axes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), InvalidInput);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    std::vector<Vector3> points = test::lumpy(1).points;
    points[5].y() = bad;
    EXPECT_ERROR(oriented_box_axes(points), InvalidInput);
  }
}

TEST(FormRatios, FollowTheirFormulas) {
  const FormRatios r = form_ratios({2.0, 3.0, 5.0});
  EXPECT_DOUBLE_EQ(r.aspect_ratio, 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(r.zingg_elongation, 3.0 / 5.0);
  EXPECT_DOUBLE_EQ(r.zingg_flatness, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(r.kong_fonseca_elongation, 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(r.kong_fonseca_flatness, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(r.krumbein_sphericity, std::cbrt(2.0 * 3.0 / 25.0));
  const FormRatios cube = form_ratios({3.0, 3.0, 3.0});
  EXPECT_DOUBLE_EQ(cube.aspect_ratio, 1.0);
  EXPECT_DOUBLE_EQ(cube.kong_fonseca_elongation, 0.0);
  EXPECT_DOUBLE_EQ(cube.kong_fonseca_flatness, 0.0);
  EXPECT_DOUBLE_EQ(cube.krumbein_sphericity, 1.0);
}

}  // namespace

namespace {

TEST(OrientationTensor, BoxIsExact) {
  // Face pairs of 6, 3 and 2 on a box of 1 x 2 x 3: eigenvalues 6/11, 3/11, 2/11.
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const OrientationTensor o = orientation_tensor(
        test::transformed(test::box(1, 2, 3), 5.0 * test::random_rotation(seed), {7, 8, 9}),
        Execution(1));
    EXPECT_NEAR(o.eigenvalues[0], 6.0 / 11.0, 1e-14);
    EXPECT_NEAR(o.eigenvalues[1], 3.0 / 11.0, 1e-14);
    EXPECT_NEAR(o.eigenvalues[2], 2.0 / 11.0, 1e-14);
    EXPECT_NEAR(o.compactness, 1.0 / 3.0, 1e-14);
    EXPECT_NEAR(o.flakiness, 0.5, 1e-14);
    EXPECT_NEAR(o.rodness, 1.0 / 6.0, 1e-14);
    EXPECT_NEAR(o.tensor.trace(), 1.0, 1e-14);
  }
}

TEST(OrientationTensor, TensorTurnsWithTheBodyAndIgnoresItsSizeAndPlace) {
  const IndexedMesh mesh = test::lumpy(3);
  const Eigen::Matrix3d plain = orientation_tensor(mesh, Execution(1)).tensor;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    const Eigen::Matrix3d turned =
        orientation_tensor(test::transformed(mesh, 5.0 * rotation, {7, 8, 9}), Execution(1)).tensor;
    // The shift rounds coordinates to 1e-15, and edges are a tenth long.
    EXPECT_LT((turned - rotation * plain * rotation.transpose()).norm(), 1e-13);
  }
}

TEST(OrientationTensor, CubeAndSphereHaveNoPreferredOrientation) {
  for (const IndexedMesh& mesh : {test::box(1, 1, 1), test::sphere(3)}) {
    const OrientationTensor o = orientation_tensor(mesh, Execution(1));
    EXPECT_NEAR(o.compactness, 1.0, 1e-12);
    EXPECT_NEAR(o.flakiness, 0.0, 1e-12);
    EXPECT_NEAR(o.rodness, 0.0, 1e-12);
  }
}

TEST(OrientationTensor, OblateSpheroidAgreesWithItsIntegral) {
  // x = (sin t cos p, sin t sin p, c cos t), dA = sin t sqrt(c^2 sin^2 t + cos^2 t) dt dp,
  // n_z^2 = cos^2 t / (c^2 sin^2 t + cos^2 t).
  const double c = 0.5;
  double area = 0.0;
  double upright = 0.0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) * test::pi / n;
    const double stretch = c * c * std::sin(t) * std::sin(t) + std::cos(t) * std::cos(t);
    area += std::sin(t) * std::sqrt(stretch);
    upright += std::sin(t) * std::cos(t) * std::cos(t) / std::sqrt(stretch);
  }
  const OrientationTensor o =
      orientation_tensor(test::scaled(test::sphere(6), {1, 1, c}), Execution(1));
  // Chords of 0.02: second order.
  EXPECT_NEAR(o.eigenvalues[0], upright / area, 2e-4);
  EXPECT_NEAR(o.rodness, 0.0, 1e-3);
}

TEST(OrientationTensor, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(5);
  const OrientationTensor one = orientation_tensor(mesh, Execution(1));
  const OrientationTensor three = orientation_tensor(mesh, Execution(3));
  EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
}

TEST(OrientationTensor, RefusesAMeshWithoutArea) {
  EXPECT_ERROR(orientation_tensor(IndexedMesh(), Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
