// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/mapped_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/random_triangulations.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "toolbox/map/sphere_map.h"
#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {
namespace {

using test::holds;

MappedSurface mapped(const IndexedMesh& mesh) {
  return MappedSurface(mesh, map_to_sphere(mesh, Execution(1)), Execution(1));
}

TEST(MappedSurface, LocatesWhatItEvaluates) {
  std::mt19937_64 engine(test::announced(3));
  std::uniform_real_distribution<double> uniform;
  for (const IndexedMesh& mesh : {test::lumpy(4), test::scaled(test::sphere(4), {1, 0.1, 0.1})}) {
    const MappedSurface surface = mapped(mesh);
    for (int i = 0; i < 2000; ++i) {
      MeshPlace place;
      place.triangle = static_cast<std::int32_t>(engine() % mesh.triangles.size());
      place.weights = Vector3(uniform(engine), uniform(engine), uniform(engine));
      place.weights /= place.weights.sum();
      const Vector3 u = surface.direction(place);
      const MeshPlace found = surface.locate(u);
      ASSERT_EQ(found.triangle, place.triangle);
      EXPECT_LT((found.weights - place.weights).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((surface.position(found) - surface.position(place)).norm(), 1e-12);
    }
  }
}

TEST(MappedSurface, FindsTheTriangle) {
  const IndexedMesh mesh = test::lumpy(3);
  const MappedSurface surface = mapped(mesh);
  for (const Vector3& u : random_directions(1000, test::announced(4))) {
    const MeshPlace place = surface.locate(u);
    const Triangle& t = mesh.triangles[place.triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(
          sphere_orientation(u, surface.directions()[t[k]], surface.directions()[t[(k + 1) % 3]]),
          0);
    }
    EXPECT_NEAR(place.weights.sum(), 1.0, 1e-15);
    EXPECT_GE(place.weights.minCoeff(), 0.0);
    EXPECT_EQ(surface.locate(3.0 * u).triangle, place.triangle);
  }
}

TEST(MappedSurface, GoesThroughTheVertices) {
  const IndexedMesh mesh = test::box(1, 2, 3);
  const MappedSurface surface = mapped(mesh);
  const std::vector<Vector3> points = surface.positions(surface.directions(), Execution(1));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_LT((points[i] - mesh.points[i]).norm(), 1e-14);
  }
}

TEST(MappedSurface, LocatesOnAnyTriangulation) {
  const std::uint64_t first = test::announced(70);
  for (std::uint64_t seed = first; seed < first + 40; ++seed) {
    const IndexedMesh mesh = test::random_triangulation(200, seed);
    const MappedSurface surface = mapped(mesh);
    for (const Vector3& u : random_directions(50, seed)) {
      const MeshPlace place = surface.locate(u);
      // Back to the direction, whatever the size of the triangle.
      EXPECT_LT((surface.direction(place) - u).norm(), 1e-7) << "seed " << seed;
    }
    for (const Vector3& u : surface.directions()) {
      EXPECT_LT((surface.direction(surface.locate(u)) - u).norm(), 1e-7) << "seed " << seed;
    }
  }
}

TEST(MappedSurface, RefusesWhatDoesNotCoverTheSphere) {
  const auto refusal = [](const IndexedMesh& mesh, const std::vector<Vector3>& directions) {
    return test::refusal(ErrorCode::InvalidInput,
                         [&] { MappedSurface(mesh, directions, Execution(1)); });
  };
  const IndexedMesh ball = test::sphere(2);
  std::vector<Vector3> directions = ball.points;
  EXPECT_EQ(refusal(ball, directions), "");
  directions.pop_back();
  EXPECT_TRUE(holds(refusal(ball, directions), "161 directions"));
  directions = ball.points;
  directions[5] *= 2.0;
  EXPECT_TRUE(holds(refusal(ball, directions), "vertex 5"));
  directions = ball.points;
  directions[5] = -directions[5];
  EXPECT_TRUE(holds(refusal(ball, directions), "is inverted"));
  IndexedMesh open = ball;
  open.triangles.pop_back();
  EXPECT_TRUE(holds(refusal(open, ball.points), "border"));
  const IndexedMesh twice = test::joined(ball, ball);
  EXPECT_TRUE(holds(refusal(twice, twice.points), "2 times"));
}

}  // namespace
}  // namespace wscvt
