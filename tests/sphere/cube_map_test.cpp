// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/cube_map.h"

#include <gtest/gtest.h>

#include <set>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

TEST(CubeMap, UsesEveryCellAndNoOther) {
  for (const int resolution : {1, 2, 7}) {
    const CubeMap cube(resolution);
    std::set<std::size_t> seen;
    for (const Vector3& u : fibonacci_lattice(20000)) seen.insert(cube.cell(u));
    EXPECT_EQ(seen.size(), cube.cells());
    EXPECT_LT(*seen.rbegin(), cube.cells());
  }
}

TEST(CubeMap, DoesNotDependOnLength) {
  const CubeMap cube(11);
  for (const Vector3& u : random_directions(1000, test::announced(3))) {
    EXPECT_EQ(cube.cell(u), cube.cell(64.0 * u));  // a power of two: no rounding
  }
}

TEST(CubeMap, VisitsEveryCellThatSeesATriangle) {
  // Small ones, ones across edges and corners of the cube, and ones that fill a third of the
  // sphere.
  for (const double size : {0.02, 0.3, 1.0, 3.0}) {
    for (const int resolution : {1, 5, 40}) {
      const CubeMap cube(resolution);
      const std::vector<Vector3> d = random_directions(600, test::announced(17));
      for (std::size_t i = 0; i + 2 < d.size(); i += 3) {
        const Vector3& a = d[i];
        const Vector3 b = a + size * d[i + 1];
        const Vector3 c = a + size * d[i + 2];
        const CubeMap::Image images[3] = {CubeMap::image(a), CubeMap::image(b), CubeMap::image(c)};
        std::set<std::size_t> visited;
        cube.visit_cells(images[0], images[1], images[2], [&](std::size_t cell) {
          EXPECT_TRUE(visited.insert(cell).second) << "twice";
        });
        EXPECT_EQ(cube.count_cells(images[0], images[1], images[2]), visited.size());
        for (int p = 0; p <= 10; ++p) {
          for (int q = 0; q <= 10 - p; ++q) {
            const Vector3 point = (p * a + q * b + (10 - p - q) * c) / 10.0;
            if (point.norm() < 1e-6) continue;
            ASSERT_EQ(visited.count(cube.cell(point)), 1U)
                << "seed 17, triangle " << i << ", size " << size << ", resolution " << resolution;
          }
        }
      }
    }
  }
}

TEST(CubeMap, VisitsFewCellsMore) {
  // A triangle about as large as a cell touches a handful, not a face of the cube.
  const int resolution = 50;
  const CubeMap cube(resolution);
  std::size_t visits = 0;
  const std::vector<Vector3> d = random_directions(3000, test::announced(5));
  for (std::size_t i = 0; i + 2 < d.size(); i += 3) {
    const double size = 1.0 / resolution;
    cube.visit_cells(CubeMap::image(d[i]), CubeMap::image(d[i] + size * d[i + 1]),
                     CubeMap::image(d[i] + size * d[i + 2]), [&](std::size_t) { ++visits; });
  }
  EXPECT_LT(visits, 8 * 1000U);
}

}  // namespace
}  // namespace wscvt
