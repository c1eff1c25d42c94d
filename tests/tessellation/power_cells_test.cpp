// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/power_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

PowerCells cells_of(const std::vector<Vector3>& seeds, const std::vector<double>& weights,
                    int threads = 1) {
  PowerCells cells;
  compute_power_cells(SphereTriangulation(seeds, weights), seeds, weights, Execution(threads),
                      cells);
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
  compute_power_cells(triangulation, sites, weights, Execution(1), cells);
  for (std::size_t t = 0; t < cells.vertices.size(); ++t) {
    const auto [a, b, c] = triangulation.triangles()[t];
    // On the ray of the vertex x the centre is t x with 2 t x.(b - a) = w_a - w_b, and so for c.
    const Vector3& x = cells.vertices[t];
    EXPECT_NEAR(x.norm(), 1.0, 1e-15);
    EXPECT_NEAR((weights[b] - weights[a]) * x.dot(sites[c] - sites[a]),
                (weights[c] - weights[a]) * x.dot(sites[b] - sites[a]), 1e-17);
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

TEST(PowerCells, AreasAndCentroidsAreThoseOfThePointsNearestToEachSite) {
  // By brute force: every one of many points on the sphere belongs to the site with the least
  // |x - site|^2 - w. Needs none of the cells' geometry.
  const std::vector<Vector3> seeds = random_directions(300, test::announced(4));
  std::vector<double> weights = linear_weights(seeds);
  const PowerCells cells = cells_of(seeds, weights);
  const std::vector<Vector3> points = fibonacci_lattice(300000);
  std::vector<double> counts(seeds.size(), 0.0);
  std::vector<Vector3> sums(seeds.size(), Vector3::Zero());
  for (const Vector3& x : points) {
    std::size_t best = 0;
    double least = 1e9;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double power = (x - seeds[i]).squaredNorm() - weights[i];
      if (power < least) {
        least = power;
        best = i;
      }
    }
    counts[best] += 1.0;
    sums[best] += x;
  }
  double area_error = 0.0;
  double shift_error = 0.0;
  double shift = 0.0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double area = counts[i] * 4.0 * pi / 300000.0;
    area_error += std::pow(cells.areas[i] / area - 1.0, 2) / 300.0;
    const Vector3 flat = sums[i] / counts[i];
    const Vector3 centroid = seeds[i] + flat - flat.dot(seeds[i]) * seeds[i];
    shift_error += (cells.centroids[i] - centroid).squaredNorm();
    shift += (centroid - seeds[i]).squaredNorm();
  }
  // Flat fans instead of the sphere: of the order of h^2 = 4 pi / 300 = 4 %. Some cells of random
  // seeds hold a few dozen points only, which adds 2 %.
  EXPECT_LT(std::sqrt(area_error), 0.06);
  EXPECT_LT(std::sqrt(shift_error / shift), 0.06);
}

TEST(PowerCells, SameBytesOnAnyNumberOfThreads) {
  const std::vector<Vector3> seeds = fibonacci_lattice(9000);
  const std::vector<double> weights = linear_weights(seeds);
  const PowerCells one = cells_of(seeds, weights, 1);
  const PowerCells two = cells_of(seeds, weights, 2);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.centroids, two.centroids);
  EXPECT_EQ(one.areas, two.areas);
}

TEST(PowerCells, RefusesArraysThatDoNotFit) {
  const std::vector<Vector3> seeds = fibonacci_lattice(10);
  PowerCells cells;
  const SphereTriangulation triangulation(seeds);
  const auto expect_refused = [&](const std::vector<Vector3>& sites, std::size_t weights) {
    test::expect_error(ErrorCode::InvalidInput, [&] {
      compute_power_cells(triangulation, sites, std::vector<double>(weights, 1.0), Execution(1),
                          cells);
    });
  };
  expect_refused(fibonacci_lattice(11), 0);
  expect_refused(seeds, 2);
}

}  // namespace
}  // namespace wscvt
