// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/sphere_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "toolbox/clump/point_blocks.h"

namespace wscvt {
namespace {

std::vector<Vector3> random_points(std::size_t count, double size, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] {
    return size * (2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0);
  };
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(number(), 0.7 * number(), number());
  return points;
}

TEST(PointBlocks, FindsTheNearestPointOfMany) {
  const std::vector<Vector3> points = random_points(700, 1.0, 5);
  const PointBlocks blocks(points);
  ASSERT_EQ(blocks.points().size(), points.size());
  for (const PointBlock& block : blocks.blocks()) {
    EXPECT_LE(block.end - block.begin, 32U);
    for (std::size_t i = block.begin; i < block.end; ++i) {
      EXPECT_LE((blocks.points()[i] - block.centre).norm(), block.radius);
    }
  }
  // Most lie in the balls of several blocks.
  for (const Vector3& to : random_points(2000, 1.1, 6)) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3& p : points) least = std::min(least, (p - to).norm());
    EXPECT_EQ((blocks.points()[blocks.nearest(to)] - to).norm(), least);
  }
}

TEST(PointBlocks, HoldEqualPoints) {
  const PointBlocks blocks(std::vector<Vector3>(100, Vector3(1, 2, 3)));
  EXPECT_EQ(blocks.points().size(), 100U);
  EXPECT_EQ(blocks.points()[blocks.nearest(Vector3::Zero())], Vector3(1, 2, 3));
}

/// Points of a surface without symmetry, of its inside and of its outside.
struct Samples {
  std::vector<Vector3> surface;
  std::vector<Vector3> inside;
  std::vector<Vector3> outside;
  Samples() {
    const auto radius = [](const Vector3& d) { return 1.0 + 0.2 * d.x() - 0.15 * d.y() * d.z(); };
    for (const Vector3& p : random_points(1500, 1.0, 1)) {
      surface.push_back(radius(p.normalized()) * p.normalized());
    }
    for (const Vector3& p : random_points(900, 1.5, 2)) {
      (p.norm() < radius(p.normalized()) ? inside : outside).push_back(p);
    }
  }
};

/// The energy by its definition.
double energy_of(const Samples& samples, const std::vector<Sphere>& spheres, double inner_weight) {
  double sum = 0.0;
  const auto add = [&](const std::vector<Vector3>& points, double lowest, double highest) {
    for (const Vector3& p : points) {
      double least = std::numeric_limits<double>::infinity();
      for (const Sphere& sphere : spheres) least = std::min(least, sphere.distance(p));
      const double residual = std::clamp(least, lowest, highest);
      sum += (residual < 0.0 ? inner_weight : 1.0) * residual * residual;
    }
  };
  const double infinity = std::numeric_limits<double>::infinity();
  add(samples.surface, -infinity, infinity);
  add(samples.inside, 0.0, infinity);
  add(samples.outside, -infinity, 0.0);
  return sum / static_cast<double>(samples.surface.size());
}

TEST(SphereFit, KeepsItsEnergyThroughAllThatChangesSpheres) {
  const Samples samples;
  SphereFit fit(samples.surface, samples.inside, samples.outside, {});
  double weight = 1.0;
  const auto check = [&] {
    const double energy = energy_of(samples, fit.spheres(), weight);
    // Sums of 2,400 in another order.
    EXPECT_NEAR(fit.energy(), energy, 1e-12 * (1.0 + energy));
  };
  // Without the least needed one it rises least.
  const auto check_least_needed = [&] {
    std::vector<double> without;
    for (std::size_t k = 0; k < fit.spheres().size(); ++k) {
      std::vector<Sphere> others = fit.spheres();
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      without.push_back(energy_of(samples, others, weight));
    }
    const auto least = std::min_element(without.begin(), without.end());
    EXPECT_EQ(fit.least_needed(), static_cast<std::size_t>(least - without.begin()));
  };
  for (const Vector3& centre : random_points(12, 0.6, 3)) {
    // Small and large ones, also outside.
    for (const Vector3& other : random_points(3, 1.4, 7)) {
      const Sphere sphere = {other + 0.3 * centre, 0.1 + 0.6 * std::abs(centre.y())};
      std::vector<Sphere> more = fit.spheres();
      more.push_back(sphere);
      if (!fit.spheres().empty()) {
        EXPECT_NEAR(fit.energy_with(sphere), energy_of(samples, more, weight), 1e-12);
      }
    }
    fit.add({centre, 0.3 + 0.2 * std::abs(centre.x())});
    check();
    if (fit.spheres().size() > 1) check_least_needed();
    for (int k = 0; k < 3; ++k) {
      const double before = fit.energy();
      fit.sweep();
      EXPECT_LE(fit.energy(), before);
      check();
    }
    weight = fit.spheres().size() % 3 == 0 ? 8.0 : 2.0;
    fit.set_inner_weight(weight);
    check();
  }
  for (const std::size_t k : {0U, 5U, 9U}) {
    fit.remove(k);
    check();
    for (int sweep = 0; sweep < 3; ++sweep) {
      fit.sweep();
      check();
    }
    check_least_needed();
  }
}

TEST(SphereFit, InsideRadiiAreDepths) {
  const Samples samples;
  const PointBlocks depths(samples.surface);
  constexpr double smallest = 0.4;
  SphereFit fit(samples.surface, samples.inside, samples.outside, {smallest, 2.0, &depths});
  for (const Vector3& centre : random_points(20, 0.5, 4)) {
    const double depth = (depths.points()[depths.nearest(centre)] - centre).norm();
    if (depth < smallest) continue;
    fit.add({centre, depth});
    for (int sweep = 0; sweep < 5; ++sweep) fit.sweep();
  }
  EXPECT_GT(fit.spheres().size(), 8U);
  for (const Sphere& sphere : fit.spheres()) {
    EXPECT_GE(sphere.radius, smallest);
    EXPECT_LT(sphere.centre.norm(), 0.8) << "inside";
    const Vector3& nearest = depths.points()[depths.nearest(sphere.centre)];
    EXPECT_NEAR((nearest - sphere.centre).norm(), sphere.radius, 1e-12);
  }
}

}  // namespace
}  // namespace wscvt
