// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/radial_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

IndexedMesh shifted(const IndexedMesh& mesh, const Vector3& shift) {
  return test::transformed(mesh, Eigen::Matrix3d::Identity(), shift);
}

TEST(RadialSamples, AreTheVerticesOfAStarShapedMesh) {
  const IndexedMesh mesh = shifted(test::lumpy(4), Vector3(0.2, -0.1, 0.1));
  const RadialSamples samples = radial_samples(mesh, Execution(1));
  ASSERT_EQ(samples.vertices.size(), mesh.points.size());
  ASSERT_EQ(samples.directions.size(), mesh.points.size());
  ASSERT_EQ(samples.weights.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_EQ(samples.vertices[i], static_cast<std::int32_t>(i));
    EXPECT_LT((mesh.points[i].norm() * samples.directions[i] - mesh.points[i]).norm(), 1e-15);
    EXPECT_NEAR(samples.directions[i].norm(), 1.0, 1e-15);
    EXPECT_GT(samples.weights[i], 0.0);
  }
  const double sum = std::accumulate(samples.weights.begin(), samples.weights.end(), 0.0);
  EXPECT_NEAR(sum, 4.0 * test::pi, 1e-12);
}

TEST(RadialSamples, WeighSymmetricVerticesAlike) {
  for (const double w : radial_samples(test::icosahedron(), Execution(1)).weights) {
    EXPECT_NEAR(w, test::pi / 3.0, 1e-14);
  }
}

TEST(RadialSamples, LeaveOutWhatLiesBehindAnotherSheet) {
  // A plate floats before the sphere: the sphere's vertices in its shadow are hidden.
  const double half = 0.5;
  const double near_side = 3.0;
  const IndexedMesh plate = shifted(test::box(2 * half, 2 * half, 0.2), Vector3(0, 0, 3.1));
  const IndexedMesh ball = test::sphere(5);
  const IndexedMesh mesh = test::joined(ball, plate);
  const RadialSamples samples = radial_samples(mesh, Execution(1));
  const auto in_shadow = [&](const Vector3& p, double factor) {
    const double edge = factor * half / near_side * p.z();
    return p.z() > 0.0 && std::abs(p.x()) < edge && std::abs(p.y()) < edge;
  };
  const auto shadow = static_cast<std::size_t>(std::count_if(
      ball.points.begin(), ball.points.end(), [&](const Vector3& p) { return in_shadow(p, 1.0); }));
  ASSERT_GT(shadow, 50U);
  // The near corners of the plate lie on the edge of its own shadow and may go either way.
  const std::size_t hidden = mesh.points.size() - samples.vertices.size();
  EXPECT_GE(hidden, shadow);
  EXPECT_LE(hidden, shadow + 4);
  for (std::size_t i = 0; i < samples.vertices.size(); ++i) {
    const Vector3& p = mesh.points[samples.vertices[i]];
    if (in_shadow(p, 0.999)) {
      EXPECT_GT(p.z(), near_side);
    }
  }
}

TEST(RadialSamples, GiveNothingFromOutside) {
  const RadialSamples samples =
      radial_samples(shifted(test::sphere(2), Vector3(3, 0, 0)), Execution(1));
  EXPECT_TRUE(samples.directions.empty());
  EXPECT_TRUE(samples.weights.empty());
  EXPECT_TRUE(samples.vertices.empty());
}

TEST(RadialSamples, AreTheSameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = shifted(test::torus(1.0, 0.7, 100), Vector3(-1, 0, 0));
  const RadialSamples one = radial_samples(mesh, Execution(1));
  const RadialSamples three = radial_samples(mesh, Execution(3));
  EXPECT_LT(one.vertices.size(), mesh.points.size());
  EXPECT_EQ(one.vertices, three.vertices);
  EXPECT_EQ(one.directions, three.directions);
  EXPECT_EQ(one.weights, three.weights);
}

TEST(RadialSamples, RefuseAnEmptyMesh) {
  EXPECT_ERROR(radial_samples({}, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
