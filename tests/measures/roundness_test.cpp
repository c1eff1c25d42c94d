// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "support/distance_bodies.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_steps.h"

namespace wscvt {
namespace {

constexpr double ball = 0.2;

/// Of a cube of half side 1 with edges of radius `rounding`, in a pose of its own.
double cube_roundness(double rounding, double spacing, std::uint64_t pose = 5) {
  const IndexedMesh mesh = test::scan_of(
      test::turned(test::rounded_box({1, 1, 1}, rounding), test::random_rotation(pose)), 1.75,
      spacing);
  return wadell_roundness(mesh, 1.0, ball, Execution(1)).roundness;
}

TEST(Roundness, OfRoundedCubesIsTheRadiusOfTheirEdges) {
  // 5,000 to 7,000 vertices, and a quarter of that.
  for (const double spacing : {0.07, 0.13}) {
    SCOPED_TRACE(spacing);
    double last = 0.0;
    for (const double rounding : {0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.0}) {
      SCOPED_TRACE(rounding);
      const double value = cube_roundness(rounding, spacing);
      if (rounding >= 0.1) {
        EXPECT_NEAR(value, rounding, 0.03);
      }
      EXPECT_GT(value, last) << "not monotone";
      last = value;
    }
  }
}

TEST(Roundness, HardlyDependsOnThePose) {
  const double first = cube_roundness(0.2, 0.09, test::announced(11));
  for (const std::uint64_t pose : {12, 13}) {
    EXPECT_NEAR(cube_roundness(0.2, 0.09, pose), first, 0.01) << "pose " << pose;
  }
}

TEST(Roundness, DoesNotDependOnTheOrderOfTheFile) {
  const IndexedMesh mesh = test::scan_of(
      test::turned(test::rounded_box({1.3, 1.0, 0.8}, 0.2), test::random_rotation(4)), 1.9, 0.06);
  const double value = wadell_roundness(mesh, 0.8, ball, Execution(1)).roundness;
  std::mt19937_64 random(test::announced(21));
  for (int k = 0; k < 3; ++k) {
    IndexedMesh other = mesh;
    for (Triangle& t : other.triangles) {
      std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random() % 3), t.end());
    }
    std::shuffle(other.triangles.begin(), other.triangles.end(), random);
    // Sums in another order differ by rounding, which may exchange two faces at the same distance.
    EXPECT_NEAR(wadell_roundness(other, 0.8, ball, Execution(1)).roundness, value, 1e-4);
  }
}

TEST(Roundness, OfABallAndOfACapsuleIsOne) {
  for (const auto& body : {test::ellipsoid({1, 1, 1}), test::capsule(1.5, 1.0)}) {
    const Roundness r = wadell_roundness(test::scan_of(body, 2.6, 0.12), 1.0, ball, Execution(1));
    EXPECT_EQ(r.roundness, 1.0);
  }
}

/// By the ellipsoid's own parameters, x = (a sin t cos p, b sin t sin p, c cos t), and the textbook
/// curvatures: with h = 1 / |x / a^2|, K = h^4 / (a b c)^2 and
/// H = h^3 (a^2 + b^2 + c^2 - |x|^2) / (2 (a b c)^2). The mean over corners is that by turn.
double ellipsoid_roundness(const Vector3& axes) {
  const double inscribed_radius = axes.minCoeff();
  const double product = axes.prod();
  double corners = 0.0;
  double turn = 0.0;
  const int n = 500;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double t = (i + 0.5) * test::pi / n;
      const double p = (j + 0.5) * 2.0 * test::pi / n;
      const Vector3 u(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
      const Vector3 x = axes.cwiseProduct(u);
      const double h = 1.0 / u.cwiseQuotient(axes).norm();
      const double part = product / h * std::sin(t);
      const double gauss = std::pow(h, 4) / (product * product);
      const double mean =
          std::pow(h, 3) * (axes.squaredNorm() - x.squaredNorm()) / (2.0 * product * product);
      const double k = mean + std::sqrt(std::max(0.0, mean * mean - gauss));
      if (k * inscribed_radius > 1.05) {
        corners += part;
        turn += k * part;
      }
    }
  }
  return corners / (turn * inscribed_radius);
}

TEST(Roundness, OfEllipsoidsIsTheMeanByTurn) {
  struct Case {
    Vector3 axes;
    double spacing;
  };
  for (const Case& c : {Case{{0.5, 0.7, 1.0}, 0.05}, Case{{0.5, 1.0, 3.0}, 0.08}}) {
    SCOPED_TRACE(::testing::Message() << "axes " << c.axes.transpose());
    const double expected = ellipsoid_roundness(c.axes);
    const IndexedMesh mesh = test::scan_of(
        test::turned(test::ellipsoid(c.axes), test::random_rotation(test::announced(2))),
        1.05 * c.axes.maxCoeff(), c.spacing);
    const Roundness r = wadell_roundness(mesh, c.axes.minCoeff(), ball, Execution(1));
    // Curvature is a mean over the ball.
    EXPECT_NEAR(r.roundness, expected, 0.03);
    EXPECT_LT(expected, 0.8);
  }
}

TEST(Roundness, SeesBodiesThatNoRayFromWithinSeesWhole) {
  const IndexedMesh mesh = test::scan_of(test::c_shape(0.2), 2.2, 0.06);
  const Roundness r = wadell_roundness(mesh, 0.5, ball, Execution(1));
  EXPECT_NEAR(r.roundness, 0.2 / 0.5, 0.03);
  // The inner edges, of radius 0, are hollow and no corners: with them a third would be lost.
}

TEST(Roundness, NamesTheSmallestRadiusThatTheMeshResolves) {
  const auto body = test::rounded_box({1, 1, 1}, 0.3);
  const Roundness fine = wadell_roundness(test::scan_of(body, 1.75, 0.07), 1.0, ball, Execution(1));
  EXPECT_NEAR(fine.ball_radius, 0.2, 1e-12);
  EXPECT_NEAR(fine.smallest_radius, 0.05, 1e-12);
  // Where edges are long the balls hold at least two and a half of them.
  const IndexedMesh mesh = test::scan_of(body, 1.75, 0.25);
  double edges = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges += (mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm();
    }
  }
  const Roundness coarse = wadell_roundness(mesh, 1.0, ball, Execution(1));
  EXPECT_NEAR(coarse.ball_radius, 2.5 * edges / (3.0 * static_cast<double>(mesh.triangles.size())),
              1e-12);
  EXPECT_NEAR(coarse.smallest_radius, 0.25 * coarse.ball_radius, 1e-12);
  EXPECT_NEAR(coarse.roundness, 0.3, 0.05);
}

TEST(Roundness, IsMissingWhereABallOfEdgesIsLargerThanTheInscribedSphere) {
  const Roundness r = wadell_roundness(test::box(2, 2, 2), 1.0, ball, Execution(1));
  EXPECT_TRUE(std::isnan(r.roundness));
  EXPECT_GT(r.smallest_radius, 0.25);
}

TEST(Roundness, DoesNotDependOnScaleOrThreads) {
  const IndexedMesh mesh = test::scan_of(test::rounded_box({1, 0.8, 0.6}, 0.2), 1.3, 0.08);
  const Roundness one = wadell_roundness(mesh, 0.6, ball, Execution(1));
  const Roundness small =
      wadell_roundness(test::moved(mesh, 1e-6, {3e-5, 0, 0}), 0.6e-6, ball, Execution(1));
  EXPECT_NEAR(one.roundness, small.roundness, 1e-6);
  EXPECT_NEAR(one.ball_radius, 1e6 * small.ball_radius, 1e-9);
  EXPECT_NEAR(one.smallest_radius, small.smallest_radius, 1e-9);
  EXPECT_EQ(one.roundness, wadell_roundness(mesh, 0.6, ball, Execution(3)).roundness);
}

TEST(Roundness, OfADenseScanIsThatOfACoarserOne) {
  // 40,000 vertices, of which 5,000 places are read.
  EXPECT_NEAR(cube_roundness(0.3, 0.028), 0.3, 0.02);
}

TEST(Roundness, RefusesRadiiThatAreNotPositive) {
  const IndexedMesh mesh = test::sphere(2);
  EXPECT_ERROR(wadell_roundness(mesh, 0.0, ball, Execution(1)), InvalidInput);
  EXPECT_ERROR(wadell_roundness(mesh, 1.0, 0.0, Execution(1)), InvalidInput);
  EXPECT_ERROR(wadell_roundness(mesh, std::nan(""), ball, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
