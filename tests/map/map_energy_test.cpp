// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/map_energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/seeds.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

/// Cotangent of the angle at a.
double cotangent(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b - a).dot(c - a) / (b - a).cross(c - a).norm();
}

TEST(ReferenceTriangle, HasTheAnglesAndTheAreaOfAnyThatIsNotFlat) {
  std::mt19937_64 engine(test::announced(1));
  std::normal_distribution<double> normal;
  int compared = 0;
  for (int round = 0; round < 200; ++round) {
    Vector3 p[3];
    for (Vector3& x : p) x = Vector3(normal(engine), normal(engine), normal(engine));
    const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    // Flatter ones are made larger on purpose.
    if (area < 0.1) continue;
    const ReferenceTriangle triangle = reference_triangle(p[0], p[1], p[2]);
    EXPECT_NEAR(triangle.area, area, 1e-12);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(triangle.cotangents[k], cotangent(p[k], p[(k + 1) % 3], p[(k + 2) % 3]), 1e-10);
    }
    ++compared;
  }
  EXPECT_GT(compared, 150);
}

TEST(ReferenceTriangle, OfFlatOnesHasCotangentsOfAThousandAtMost) {
  const Vector3 a(0, 0, 0);
  for (const Vector3& c : {Vector3(2, 0, 0), Vector3(0.5, 0, 0), Vector3(1, 0, 0), Vector3(0, 0, 0),
                           Vector3(0.5, 1e-9, 0), Vector3(-3, 1e-5, 0)}) {
    for (const double scale : {1.0, 1e-3, 1e3}) {
      const ReferenceTriangle triangle =
          reference_triangle(scale * a, scale * Vector3(1, 0, 0), scale * c);
      EXPECT_GT(triangle.area, 0.0);
      double largest = 0.0;
      for (const double value : triangle.cotangents) largest = std::max(largest, std::abs(value));
      EXPECT_LT(largest, 1500.0);
      EXPECT_GT(largest, 10.0);
      // Larger by a thousandth of its edges at most: its area is no more than that of a triangle
      // whose height is a twentieth of its longest edge.
      const double longest = scale * std::max({1.0, c.norm(), (c - Vector3(1, 0, 0)).norm()});
      EXPECT_LT(triangle.area, 0.05 * longest * longest);
    }
  }
}

/// A vertex on the sphere between its neighbours, with triangles of the surface that are far from
/// their images.
struct Fan {
  std::vector<Vector3> ring;
  std::vector<ReferenceTriangle> references;
  VertexFan fan;

  Fan(std::mt19937_64& engine, double size) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Eigen::Matrix3d rotation = test::random_rotation(engine());
    const int count = 4 + static_cast<int>(engine() % 5);
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * test::pi * (i + 0.6 * share(engine)) / count;
      const double reach = size * (0.5 + share(engine));
      ring.push_back(rotation *
                     Vector3(reach * std::cos(angle), reach * std::sin(angle), 1.0).normalized());
    }
    middle = rotation.col(2);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto bent = [&]() -> Vector3 {
        return size * Vector3(share(engine), share(engine), share(engine));
      };
      references.push_back(reference_triangle(middle + bent(), ring[i] + bent(), next(i) + bent()));
      const ReferenceTriangle& r = references.back();
      fan.add(ring[i], next(i), r.cotangents[0], r.cotangents[1], r.cotangents[2], r.area * r.area);
    }
  }
  const Vector3& next(std::size_t i) const { return ring[(i + 1) % ring.size()]; }

  /// The sum that the header has.
  double energy(const Vector3& p) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector3& q = ring[i];
      const Vector3& r = next(i);
      const double area = 0.5 * p.dot(q.cross(r));
      if (!(area > 0.0)) return std::numeric_limits<double>::infinity();
      const auto& c = references[i].cotangents;
      const double dirichlet = 0.5 * (c[0] * (q - r).squaredNorm() + c[1] * (r - p).squaredNorm() +
                                      c[2] * (p - q).squaredNorm());
      const double ratio = references[i].area / area;
      sum += dirichlet * (1.0 + ratio * ratio);
    }
    return sum;
  }

  Vector3 middle;
};

TEST(VertexFan, EnergyIsTheSymmetricDirichletEnergy) {
  std::mt19937_64 engine(test::announced(2));
  std::uniform_real_distribution<double> off(-1.0, 1.0);
  int inside = 0;
  int outside = 0;
  for (int round = 0; round < 100; ++round) {
    const double size = round % 2 == 0 ? 0.5 : 0.01;
    const Fan fan(engine, size);
    for (int k = 0; k < 10; ++k) {
      const Vector3 p =
          (fan.middle + size * Vector3(off(engine), off(engine), off(engine))).normalized();
      const double expected = fan.energy(p);
      const double energy = fan.fan.energy(p);
      ASSERT_EQ(std::isinf(energy), std::isinf(expected));
      if (std::isinf(expected)) {
        ++outside;
      } else {
        ++inside;
        // Areas beside a side of the ring come from differences.
        EXPECT_NEAR(energy / expected, 1.0, 1e-8);
      }
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
  // On a side of the ring it is not certain which way a triangle looks.
  const Fan fan(engine, 0.5);
  EXPECT_TRUE(std::isinf(fan.fan.energy((fan.ring[0] + fan.ring[1]).normalized())));
}

TEST(VertexFan, ImproveGoesToTheLeastEnergyInAFewStepsOfNewton) {
  std::mt19937_64 engine(test::announced(3));
  std::uniform_real_distribution<double> off(-1.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    const double size = round % 2 == 0 ? 0.5 : 0.01;
    const Fan fan(engine, size);
    Vector3 p = fan.middle;
    double way = 1.0;
    int steps = 0;
    for (; steps < 30 && way > 1e-20; ++steps) {
      const Vector3 before = p;
      double edges = 0.0;
      for (const Vector3& q : fan.ring) edges += (q - before).squaredNorm();
      way = fan.fan.improve(p);
      EXPECT_NEAR(p.norm(), 1.0, 1e-15);
      EXPECT_LE(fan.fan.energy(p), fan.fan.energy(before));
      EXPECT_NEAR(way, (p - before).squaredNorm() * static_cast<double>(fan.ring.size()) / edges,
                  1e-12 * way);
    }
    EXPECT_LE(steps, 10);  // measured: 7 at most
    // Nowhere about it is less.
    const double least = fan.fan.energy(p);
    for (int k = 0; k < 200; ++k) {
      const double reach = size * std::pow(10.0, -k % 5);
      const Vector3 other =
          (p + reach * Vector3(off(engine), off(engine), off(engine))).normalized();
      EXPECT_GE(fan.fan.energy(other), least * (1.0 - 1e-12));
    }
  }
}

TEST(VertexFan, ImproveLeavesAVertexThatStandsOutsideOfItsRing) {
  std::mt19937_64 engine(test::announced(4));
  const Fan fan(engine, 0.5);
  Vector3 p = -fan.middle;
  EXPECT_EQ(fan.fan.improve(p), 0.0);
  EXPECT_EQ(p, -fan.middle);
}

}  // namespace
}  // namespace wscvt
