// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/power_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>

#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

constexpr double pi = 3.14159265358979323846;

PowerCells cells_of(const std::vector<Vector3>& seeds, const std::vector<double>& weights,
                    int threads = 1) {
  PowerCells cells;
  compute_power_cells(SphereTriangulation(seeds, weights), seeds, weights, {},
                      CellGeometry::UnitSphere, Execution(threads), cells);
  return cells;
}

std::vector<double> linear_weights(const std::vector<Vector3>& seeds) {
  std::vector<double> weights;
  for (const Vector3& p : seeds) {
    weights.push_back(2.0 / static_cast<double>(seeds.size()) * (p.x() + 0.3 * p.z()));
  }
  return weights;
}

TEST(PowerCells, VerticesHaveEqualPowerToTheirThreeSites) {
  const std::vector<Vector3> sites = fibonacci_lattice(200);
  const std::vector<double> weights = linear_weights(sites);
  const SphereTriangulation triangulation(sites, weights);
  PowerCells cells;
  // On a surface the centres are left in their triangles' planes, where the property is exact.
  compute_power_cells(triangulation, sites, weights, {}, CellGeometry::Surface, Execution(1),
                      cells);
  for (std::size_t t = 0; t < cells.vertices.size(); ++t) {
    const Triangle& corners = triangulation.triangles()[t];
    const auto power = [&](std::int32_t i) {
      return (cells.vertices[t] - sites[i]).squaredNorm() - weights[i];
    };
    EXPECT_NEAR(power(corners[0]), power(corners[1]), 1e-14);
    EXPECT_NEAR(power(corners[0]), power(corners[2]), 1e-14);
  }
}

TEST(PowerCells, CellsCoverTheSphere) {
  // Flat fans and projected areas miss of the order of h^2 = 4 pi / N of the sphere.
  for (const int count : {100, 1000, 10000}) {
    const std::vector<Vector3> seeds = fibonacci_lattice(count);
    for (const auto& weights : {std::vector<double>(), linear_weights(seeds)}) {
      const PowerCells cells = cells_of(seeds, weights);
      const double total = std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0);
      EXPECT_NEAR(total / (4.0 * pi), 1.0, 4.0 * pi / count);
    }
  }
}

TEST(PowerCells, RegularPolyhedraAreTheirOwnCentroids) {
  for (const auto& seeds : {subdivided_icosahedron(1), equal_angle_grid(1)}) {
    const PowerCells cells = cells_of(seeds, {});
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      EXPECT_NEAR((cells.centroids[i].normalized() - seeds[i]).norm(), 0.0, 1e-14);
      EXPECT_NEAR(cells.areas[i], cells.areas[0], 1e-14);
    }
  }
}

TEST(PowerCells, RaisingOneWeightGrowsThatCellOnly) {
  const std::vector<Vector3> seeds = fibonacci_lattice(300);
  std::vector<double> weights(seeds.size(), 0.0);
  const PowerCells before = cells_of(seeds, weights);
  weights[150] = 0.3 * 4.0 * pi / 300.0;
  const PowerCells after = cells_of(seeds, weights);
  EXPECT_GT(after.areas[150], 1.3 * before.areas[150]);
  EXPECT_EQ(after.areas[0], before.areas[0]);
  EXPECT_NEAR(std::accumulate(after.areas.begin(), after.areas.end(), 0.0),
              std::accumulate(before.areas.begin(), before.areas.end(), 0.0), 1e-3);
}

TEST(PowerCells, DensityPullsTheCentroidTowardsIt) {
  const std::vector<Vector3> seeds = fibonacci_lattice(400);
  const SphereTriangulation triangulation(seeds);
  std::vector<double> densities;
  for (const Vector3& p : seeds) densities.push_back(std::exp(2.0 * p.z()));
  PowerCells plain;
  PowerCells dense;
  compute_power_cells(triangulation, seeds, {}, {}, CellGeometry::UnitSphere, Execution(1), plain);
  compute_power_cells(triangulation, seeds, {}, densities, CellGeometry::UnitSphere, Execution(1),
                      dense);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (std::abs(seeds[i].z()) < 0.9) {
      EXPECT_GT(dense.centroids[i].z(), plain.centroids[i].z());
    }
    EXPECT_EQ(dense.areas[i], plain.areas[i]);
  }
  const std::vector<double> constant(seeds.size(), 4.0);
  PowerCells even;
  compute_power_cells(triangulation, seeds, {}, constant, CellGeometry::UnitSphere, Execution(1),
                      even);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    EXPECT_NEAR((even.centroids[i] - plain.centroids[i]).norm(), 0.0, 1e-15);
  }
  EXPECT_NEAR(even.energy, 4.0 * plain.energy, 1e-14);
}

TEST(PowerCells, EnergyHasItsMinimumGradientAtTheCentroids) {
  // dE/dp_i = 2 area (p_i - centroid) for cells of equal power, by finite differences. The flat
  // fans follow the sphere only to h^2 = 4 pi / N = 0.6 %, which bounds the agreement.
  std::vector<Vector3> seeds = random_directions(2000, test::announced(4));
  const PowerCells cells = cells_of(seeds, {});
  const std::size_t i = 700;
  const Vector3 along = seeds[i].unitOrthogonal();
  const double step = 1e-5;
  const Vector3 kept = seeds[i];
  seeds[i] = (kept + step * along).normalized();
  const double plus = cells_of(seeds, {}).energy;
  seeds[i] = (kept - step * along).normalized();
  const double minus = cells_of(seeds, {}).energy;
  const double expected = 2.0 * cells.areas[i] * (kept - cells.centroids[i]).dot(along);
  EXPECT_NEAR((plus - minus) / (2.0 * step), expected, 0.05 * std::abs(expected));
}

TEST(PowerCells, SameBytesOnAnyNumberOfThreads) {
  const std::vector<Vector3> seeds = fibonacci_lattice(9000);
  const std::vector<double> weights = linear_weights(seeds);
  const PowerCells one = cells_of(seeds, weights, 1);
  const PowerCells two = cells_of(seeds, weights, 2);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.centroids, two.centroids);
  EXPECT_EQ(one.areas, two.areas);
  EXPECT_EQ(std::memcmp(&one.energy, &two.energy, sizeof one.energy), 0);
}

TEST(PowerCells, RefusesArraysThatDoNotFit) {
  const std::vector<Vector3> seeds = fibonacci_lattice(10);
  PowerCells cells;
  EXPECT_THROW(compute_power_cells(SphereTriangulation(seeds), seeds, {1.0, 2.0}, {},
                                   CellGeometry::UnitSphere, Execution(1), cells),
               Error);
}

}  // namespace
}  // namespace wscvt
