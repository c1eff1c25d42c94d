// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/mapped_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "support/expect_error.h"
#include "support/random_triangulations.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "toolbox/map/sphere_map.h"
#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {
namespace {

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

TEST(MappedSurface, FindsTheTriangleFromAnywhere) {
  const IndexedMesh mesh = test::lumpy(3);
  const MappedSurface surface = mapped(mesh);
  const auto faces = static_cast<std::int32_t>(mesh.triangles.size());
  std::int32_t hint = 0;
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
    hint = (hint + 7919) % faces;
    EXPECT_EQ(surface.locate(u, hint).triangle, place.triangle);
    EXPECT_EQ(surface.locate(3.0 * u).triangle, place.triangle);
  }
}

TEST(MappedSurface, GoesThroughTheVertices) {
  const IndexedMesh mesh = test::box(1, 2, 3);
  const MappedSurface surface = mapped(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_LT((surface.position(surface.directions()[i]) - mesh.points[i]).norm(), 1e-14);
  }
}

TEST(MappedSurface, LocatesOnAnyTriangulation) {
  const std::uint64_t first = test::announced(70);
  for (std::uint64_t seed = first; seed < first + 40; ++seed) {
    const IndexedMesh mesh = test::random_triangulation(200, seed);
    const MappedSurface surface = mapped(mesh);
    for (const Vector3& u : random_directions(50, seed)) {
      const MeshPlace place = surface.locate(u, 0);
      // Back to the direction, whatever the size of the triangle.
      EXPECT_LT((surface.direction(place) - u).norm(), 1e-7) << "seed " << seed;
    }
    for (const Vector3& u : surface.directions()) {
      EXPECT_LT((surface.direction(surface.locate(u)) - u).norm(), 1e-7) << "seed " << seed;
    }
  }
}

TEST(MappedSurface, NormalsAreThoseOfTheFaces) {
  const IndexedMesh mesh = test::box(1, 2, 3);
  const MappedSurface surface = mapped(mesh);
  for (const Vector3& u : random_directions(100, test::announced(5))) {
    const MeshPlace place = surface.locate(u);
    const Vector3 x = surface.position(place);
    const Vector3 n = surface.normal(place);
    // On the face of the box that the point lies on.
    EXPECT_NEAR((n.array() * x.array()).sum(),
                (n.array().abs() * Eigen::Array3d(0.5, 1.0, 1.5)).sum(), 1e-12);
    EXPECT_NEAR(n.norm(), 1.0, 1e-14);
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
  EXPECT_NE(refusal(ball, directions).find("161 directions"), std::string::npos);
  directions = ball.points;
  directions[5] *= 2.0;
  EXPECT_NE(refusal(ball, directions).find("vertex 5"), std::string::npos);
  directions = ball.points;
  directions[5] = -directions[5];
  EXPECT_NE(refusal(ball, directions).find("is inverted"), std::string::npos);
  IndexedMesh open = ball;
  open.triangles.pop_back();
  EXPECT_NE(refusal(open, ball.points).find("border"), std::string::npos);
  const IndexedMesh twice = test::joined(ball, ball);
  EXPECT_NE(refusal(twice, twice.points).find("2 times"), std::string::npos);
}

TEST(MappedSurface, DerivativesAreThoseWithinAFace) {
  // So few faces that hardly a step leaves one; where it does nothing can be said.
  const IndexedMesh mesh = test::box(1, 2, 3);
  const MappedSurface surface(mesh, map_to_sphere(mesh, Execution(1)), Execution(1));
  const double step = 1e-5;
  int compared = 0;
  for (const Vector3& u : random_directions(200, test::announced(10))) {
    SurfaceJet jet;
    surface.evaluate_jets(&u, 1, Derivatives::Second, &jet);
    if (surface.locate(u).weights.minCoeff() < 1e-3) continue;
    ++compared;
    for (int a = 0; a < 3; ++a) {
      const std::vector<Vector3> around{(u + step * Vector3::Unit(a)).normalized(),
                                        (u - step * Vector3::Unit(a)).normalized()};
      const auto jets = surface.surface_jets(around, Derivatives::First, Execution(1));
      const Vector3 slope = (jets[0].position - jets[1].position) / (2.0 * step);
      EXPECT_LT((jet.jacobian.col(a) - slope).norm(), 1e-7 * (1.0 + slope.norm()));
      const double length = std::sqrt(1.0 + step * step);
      for (int k = 0; k < 3; ++k) {
        const Vector3 bend =
            (jets[0].jacobian.row(k) - jets[1].jacobian.row(k)).transpose() / (2.0 * step * length);
        // The length differs by u's own part of the step, to first order.
        const Vector3 scaled = bend - u[a] * jet.jacobian.row(k).transpose();
        EXPECT_LT((jet.hessians[static_cast<std::size_t>(k)].col(a) - scaled).norm(),
                  1e-5 * (1.0 + scaled.norm()));
      }
    }
    // Flat.
    const PrincipalCurvatures curvatures = principal_curvatures(jet, u);
    EXPECT_NEAR(curvatures.maximum, 0.0, 1e-9);
    EXPECT_NEAR(curvatures.minimum, 0.0, 1e-9);
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace wscvt
