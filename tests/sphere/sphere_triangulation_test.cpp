// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

void expect_closed_sphere(const SphereTriangulation& triangulation,
                          const std::vector<Vector3>& seeds) {
  ASSERT_EQ(triangulation.vertex_count(), seeds.size());
  ASSERT_EQ(triangulation.triangles().size(), 2 * seeds.size() - 4);
  const auto half_edges = static_cast<std::int32_t>(triangulation.opposite().size());
  std::set<std::pair<std::int32_t, std::int32_t>> directed;
  for (std::int32_t h = 0; h < half_edges; ++h) {
    const std::int32_t o = triangulation.opposite()[h];
    ASSERT_GE(o, 0);
    ASSERT_EQ(triangulation.opposite()[o], h);
    const std::int32_t from = triangulation.origin(h);
    const std::int32_t to = triangulation.origin(next_half_edge(h));
    ASSERT_EQ(triangulation.origin(o), to);
    ASSERT_NE(from, to);
    ASSERT_TRUE(directed.emplace(from, to).second) << "edge " << from << "-" << to << " twice";
  }
  for (std::size_t v = 0; v < seeds.size(); ++v) {
    ASSERT_EQ(triangulation.origin(triangulation.first_half_edge()[v]), static_cast<int>(v));
  }
  for (const Triangle& t : triangulation.triangles()) {
    EXPECT_GT(seeds[t[0]].dot(seeds[t[1]].cross(seeds[t[2]])), 0.0);
  }
}

// No seed lies above the plane of any triangle of the lifted hull (brute force).
void expect_convex(const SphereTriangulation& triangulation, const std::vector<Vector3>& seeds,
                   const std::vector<double>& weights) {
  std::vector<Vector3> lifted = seeds;
  for (std::size_t i = 0; i < weights.size(); ++i) lifted[i] *= std::exp(0.5 * weights[i]);
  for (const Triangle& t : triangulation.triangles()) {
    const Vector3 normal =
        (lifted[t[1]] - lifted[t[0]]).cross(lifted[t[2]] - lifted[t[0]]).normalized();
    for (const Vector3& p : lifted) {
      // Coordinates are of order 1, so the distance is exact to a few 1e-16 / sin(angle).
      EXPECT_LT(normal.dot(p - lifted[t[0]]), 1e-12);
    }
  }
}

std::vector<double> moderate_weights(const std::vector<Vector3>& seeds) {
  // A third of the mean squared distance of neighbours is well short of hiding a seed.
  std::vector<double> weights;
  for (const Vector3& p : seeds) {
    weights.push_back(1.2 / static_cast<double>(seeds.size()) * (1.0 + p.x() - 0.5 * p.y()));
  }
  return weights;
}

std::vector<Triangle> sorted_triangles(const SphereTriangulation& triangulation) {
  std::vector<Triangle> triangles = triangulation.triangles();
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(SphereTriangulation, IsAClosedConvexHullForEverySize) {
  for (const int count : {4, 5, 12, 100, 400}) {
    SCOPED_TRACE(count);
    const std::vector<Vector3> seeds = fibonacci_lattice(count);
    const SphereTriangulation plain(seeds);
    expect_closed_sphere(plain, seeds);
    expect_convex(plain, seeds, {});
    const std::vector<double> weights = moderate_weights(seeds);
    const SphereTriangulation regular(seeds, weights);
    expect_closed_sphere(regular, seeds);
    expect_convex(regular, seeds, weights);
  }
}

TEST(SphereTriangulation, WorksOnSymmetricSeedsWhereManyAreCocircular) {
  for (const auto& seeds : {equal_angle_grid(9), subdivided_icosahedron(4), equal_angle_grid(1)}) {
    expect_closed_sphere(SphereTriangulation(seeds), seeds);
  }
}

TEST(SphereTriangulation, TakesTrianglesThatAreThereFromFourSeedsOn) {
  for (const int count : {4, 5, 100}) {
    const std::vector<Vector3> seeds = fibonacci_lattice(count);
    // What seeds are triangulated by first: the hull, several times as slow, would give the same.
    const std::vector<Triangle> triangles = sphere_delaunay(seeds, Execution(1));
    EXPECT_EQ(triangles.size(), 2U * count - 4U);
    const SphereTriangulation kept(seeds, triangles);
    expect_closed_sphere(kept, seeds);
    EXPECT_EQ(sorted_triangles(kept), SphereTriangulation(seeds).triangles());
    std::vector<Triangle> open = triangles;
    open.pop_back();
    EXPECT_ERROR(SphereTriangulation(seeds, open), InvalidInput);
  }
}

TEST(SphereTriangulation, DoesNotDependOnTheOrderOfTheSeeds) {
  const std::vector<Vector3> seeds = random_directions(300, test::announced(11));
  std::vector<std::int32_t> order(seeds.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(test::announced(5)));
  std::vector<Vector3> shuffled;
  for (const std::int32_t i : order) shuffled.push_back(seeds[i]);
  std::vector<Triangle> triangles = SphereTriangulation(shuffled).triangles();
  for (Triangle& t : triangles) {
    for (std::int32_t& v : t) v = order[v];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  EXPECT_EQ(triangles, SphereTriangulation(seeds).triangles());
}

TEST(SphereTriangulation, FlipsReachWhatBuildingFromScratchReaches) {
  constexpr std::uint64_t seed = 3;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::vector<Vector3> seeds = fibonacci_lattice(2000);
  SphereTriangulation kept(seeds);
  const std::vector<Vector3> noise = random_directions(2000, seed);
  int flips = 0;
  for (int round = 0; round < 5; ++round) {
    // A quarter of h = sqrt(4 pi / N): changes neighbours without turning triangles over.
    const double length = 0.07 * std::sqrt(4.0 * pi / 2000.0);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      seeds[i] = (seeds[i] + length * noise[(i + 97 * round) % noise.size()]).normalized();
    }
    const std::vector<double> weights = moderate_weights(seeds);
    const auto repair = kept.restore_regular(seeds, weights, Execution(2));
    ASSERT_TRUE(repair.complete);
    flips += repair.flips;
    expect_closed_sphere(kept, seeds);
    EXPECT_EQ(sorted_triangles(kept), SphereTriangulation(seeds, weights).triangles());
  }
  EXPECT_GT(flips, 100);
}

// A turned grid: each of its cells is four seeds on one circle but for rounding, so predicates that
// round contradict each other.
TEST(SphereTriangulation, FlipsEndOnSeedsThatAreNearlyCocircular) {
  const std::uint64_t seed = test::announced(17);
  std::vector<Vector3> grid = equal_angle_grid(30);
  const SphereTriangulation start(grid);
  for (const Vector3& axis : random_directions(5, seed)) {
    const Eigen::AngleAxisd turn(1.0 + axis.x(), axis);
    std::vector<Vector3> seeds;
    for (const Vector3& p : grid) seeds.push_back((turn * p).normalized());
    SphereTriangulation kept(seeds, std::vector<Triangle>(start.triangles()));
    const auto repair = kept.restore_regular(seeds, {}, Execution(1));
    EXPECT_TRUE(repair.complete);
    EXPECT_GT(repair.flips, 100);  // every cell is to be decided anew
    expect_closed_sphere(kept, seeds);
    EXPECT_EQ(kept.restore_regular(seeds, {}, Execution(1)).flips, 0);
  }
}

TEST(SphereTriangulation, SurfaceFlipsMakeOppositeAnglesSumToAtMostPi) {
  // Squeezed towards the poles seeds are as close as those of a million, and triangles as small:
  // they must be flipped all the same.
  for (const double squeeze : {1.0, 30.0}) {
    SCOPED_TRACE(squeeze);
    std::vector<Vector3> seeds;
    std::vector<Vector3> positions;
    for (const Vector3& p : fibonacci_lattice(500)) {
      seeds.push_back(p.cwiseProduct(Vector3(1.0, 1.0, squeeze)).normalized());
      positions.push_back(p.cwiseProduct(Vector3(2.0, 1.0, 0.8)));
    }
    SphereTriangulation triangulation(seeds);
    const auto repair = triangulation.restore_surface_delaunay(seeds, positions, Execution(1));
    EXPECT_GT(repair.flips, 0);
    EXPECT_TRUE(repair.complete);
    expect_closed_sphere(triangulation, seeds);
    const auto angle = [&](std::int32_t h) {
      const Vector3& apex = positions[triangulation.origin(previous_half_edge(h))];
      const Vector3 a = positions[triangulation.origin(h)] - apex;
      const Vector3 b = positions[triangulation.origin(next_half_edge(h))] - apex;
      return std::atan2(a.cross(b).norm(), a.dot(b));
    };
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(triangulation.opposite().size()); ++h) {
      EXPECT_LT(angle(h) + angle(triangulation.opposite()[h]), pi + 1e-9);
    }
  }
}

TEST(SphereTriangulation, SurfaceFlipsLeaveNoTriangleFlat) {
  // Great circles run through rows of seeds of a subdivided icosahedron; on long bodies the flips
  // used to make triangles of three seeds in one row, whose determinant was that of rounding.
  for (const int frequency : {2, 4, 8}) {
    const std::vector<Vector3> seeds = subdivided_icosahedron(frequency);
    for (const Vector3& axes : {Vector3(0.3, 2.3, 0.5), Vector3(5, 1, 1), Vector3(1, 1, 0.1),
                                Vector3(1, 12, 0.4), Vector3(0.1, 0.5, 8)}) {
      SCOPED_TRACE(axes.transpose());
      std::vector<Vector3> positions;
      for (const Vector3& u : seeds) positions.push_back(u / u.cwiseQuotient(axes).norm());
      SphereTriangulation triangulation(seeds);
      triangulation.restore_surface_delaunay(seeds, positions, Execution(1));
      expect_closed_sphere(triangulation, seeds);
      for (const Triangle& t : triangulation.triangles()) {
        // Height over longest side above 1e-6, times a longest side of at least 0.1, squared.
        EXPECT_GT(seeds[t[0]].dot(seeds[t[1]].cross(seeds[t[2]])), 1e-8);
      }
    }
  }
}

TEST(SphereTriangulation, ReportsTrianglesTurnedOver) {
  std::vector<Vector3> seeds = fibonacci_lattice(100);
  SphereTriangulation triangulation(seeds);
  std::swap(seeds[10], seeds[60]);
  const auto repair = triangulation.restore_regular(seeds, {}, Execution(1));
  EXPECT_FALSE(repair.complete);
  EXPECT_EQ(repair.flips, 0);
}

TEST(SphereTriangulation, RefusesWhatHasNoTriangulation) {
  EXPECT_ERROR(SphereTriangulation(fibonacci_lattice(3)), InvalidInput);
  std::vector<Vector3> hemisphere = fibonacci_lattice(40);
  for (Vector3& p : hemisphere) p.z() = std::abs(p.z());
  EXPECT_ERROR(SphereTriangulation{hemisphere}, NumericalFailure);
  std::vector<Vector3> twice = fibonacci_lattice(40);
  twice[7] = twice[8];
  EXPECT_ERROR(SphereTriangulation{twice}, NumericalFailure);
  std::vector<double> weights(40, 0.0);
  weights[20] = -2.0;  // far below its neighbours' power: hidden
  EXPECT_ERROR(SphereTriangulation(fibonacci_lattice(40), weights), NumericalFailure);
  EXPECT_ERROR(SphereTriangulation(fibonacci_lattice(40), std::vector<double>(39, 0.0)),
               InvalidInput);
}

TEST(SphereTriangulation, RefusesSeedsThatAreNotNumbers) {
  // They ended the program in the numbers behind the exact predicates.
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    std::vector<Vector3> seeds = fibonacci_lattice(50);
    const std::vector<Triangle> triangles = SphereTriangulation(seeds).triangles();
    seeds[7].y() = wrong;
    EXPECT_ERROR(SphereTriangulation{seeds}, InvalidInput);
    EXPECT_ERROR(SphereTriangulation(seeds, triangles), InvalidInput);
  }
}

TEST(SphereTriangulation, ReportsAndCanBeCancelled) {
  const std::vector<Vector3> seeds = fibonacci_lattice(50000);
  int calls = 0;
  const Execution counting(1, [&](double, const std::string&) { return ++calls < 4; });
  EXPECT_ERROR(sphere_delaunay(seeds, counting), Cancelled);
  EXPECT_EQ(calls, 4);
}

TEST(SphereTriangulation, RefusesWeightsThatCannotBeLifted) {
  // exp(w / 2) would overflow, or make every comparison false; the whole sphere has 4 pi steradian.
  const std::vector<Vector3> seeds = fibonacci_lattice(40);
  for (const double weight :
       {1e4, -1e4, 1e300, std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    SCOPED_TRACE(weight);
    std::vector<double> weights(seeds.size(), 0.0);
    weights[20] = weight;
    try {
      const SphereTriangulation triangulation(seeds, weights);
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::NumericalFailure);
    }
    SphereTriangulation kept(seeds);
    EXPECT_FALSE(kept.restore_regular(seeds, weights, Execution(1)).complete);
    expect_closed_sphere(kept, seeds);
  }
}

TEST(SphereTriangulation, SubdividedSphereHasTheFacesOfTheIcosahedronCutUp) {
  for (const int frequency : {1, 2, 7}) {
    const IndexedMesh sphere = subdivided_sphere(frequency);
    const auto square = static_cast<std::size_t>(frequency * frequency);
    EXPECT_EQ(sphere.points, subdivided_icosahedron(frequency));
    EXPECT_EQ(sphere.points.size(), 10 * square + 2);
    EXPECT_EQ(sphere.triangles.size(), 20 * square);
    // Throws unless they are closed and counter-clockwise.
    EXPECT_NO_THROW(SphereTriangulation(sphere.points, sphere.triangles));
  }
  EXPECT_ERROR(subdivided_sphere(0), InvalidInput);
}

}  // namespace

namespace {

TEST(Orientation, HasTheSignOfTheDeterminant) {
  const Vector3 a(0, 0, 1);
  const Vector3 b(1, 0, 1);
  const Vector3 c(0, 1, 1);
  EXPECT_EQ(orientation(a, b, c, {0, 0, 2}), 1);
  EXPECT_EQ(orientation(a, b, c, {5, 7, 0}), -1);
  EXPECT_EQ(orientation(a, b, c, {-3, 4, 1}), 0);
  EXPECT_TRUE(counter_clockwise({1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
  EXPECT_FALSE(counter_clockwise({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));
  EXPECT_EQ(sphere_orientation({1, 0, 0}, {0, 1, 0}, {1, 1, 0}), 0);
}

// Points within a last place of a plane: the determinant in doubles is mostly noise.
TEST(Orientation, IsExactNextToAPlane) {
  std::mt19937_64 random(test::announced(5));
  int differ = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto number = [&] { return 0.5 + std::ldexp(static_cast<double>(random() >> 44), -20); };
    const Vector3 a(number(), number(), 0.0);
    const Vector3 b(number(), number(), 0.0);
    const Vector3 c(number(), number(), 0.0);
    // Twenty-bit coordinates: this determinant, the turn of abc in the plane, has no rounding.
    const double turn = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    const int side = turn > 0.0 ? 1 : turn < 0.0 ? -1 : 0;
    const double height = std::ldexp(1.0, -80);
    const Vector3 shear(number(), number(), number());
    // Leaning the plane rounds; the answers for above and below must still be opposite, and stay
    // the same when the corners are passed on in turn.
    const auto lean = [&](const Vector3& p) { return Vector3(p + shear * (p.x() + p.y())); };
    EXPECT_EQ(orientation(a, b, c, Vector3(0.7, 0.6, height)), side);
    EXPECT_EQ(orientation(a, b, c, Vector3(0.7, 0.6, -height)), -side);
    const Vector3 d = lean(Vector3(0.7, 0.6, 0.0));
    const int exact = orientation(lean(a), lean(b), lean(c), d);
    EXPECT_EQ(orientation(lean(b), lean(c), lean(a), d), exact);
    EXPECT_EQ(orientation(lean(b), lean(a), lean(c), d), -exact);
    EXPECT_EQ(orientation(d, lean(c), lean(b), lean(a)), exact);
    const double rounded = (lean(b) - lean(a)).cross(lean(c) - lean(a)).dot(Vector3(d - lean(a)));
    if ((rounded > 0.0 ? 1 : rounded < 0.0 ? -1 : 0) != exact) ++differ;
  }
  EXPECT_GT(differ, 100);  // else this test could not tell exact from rounded
}

}  // namespace
}  // namespace wscvt
