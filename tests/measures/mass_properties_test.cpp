// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

MassProperties mass_of(const IndexedMesh& mesh) {
  return mass_properties(describe_shape(mesh, Execution(1)));
}

/// The smallest angle by which one frame would have to be turned to become the other, radians.
double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return a.angularDistance(b);
}

/// A body without symmetry whose moments are well apart.
IndexedMesh uneven_body() {
  IndexedMesh mesh = test::scaled(test::lumpy(4), {1.0, 1.4, 0.7});
  for (Vector3& p : mesh.points) p.y() *= 1.0 + 0.15 * p.y();  // lumpy is symmetric in y
  return mesh;
}

TEST(MassProperties, OfABoxInClosedForm) {
  const MassProperties mass =
      mass_of(test::transformed(test::box(1, 2, 3), Eigen::Matrix3d::Identity(), {7, 8, 9}));
  EXPECT_NEAR(mass.volume, 6.0, 1e-12);
  EXPECT_LT((mass.centroid - Vector3(7, 8, 9)).norm(), 1e-12);
  // V (y^2 + z^2) / 12 about x, and in turn: least about the longest edge, z.
  EXPECT_LT((mass.principal_moments - Vector3(2.5, 5.0, 6.5)).norm(), 1e-11);
  EXPECT_LT((mass.principal_axes * Vector3::UnitX() - Vector3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((mass.principal_axes * Vector3::UnitY() - Vector3::UnitY()).norm(), 1e-9);
  EXPECT_LT((mass.principal_axes * Vector3::UnitZ() + Vector3::UnitX()).norm(), 1e-9);
}

TEST(MassProperties, OfATurnedEllipsoidInClosedForm) {
  const Vector3 axes(0.5, 0.7, 1.0);
  const Eigen::Matrix3d turn = test::random_rotation(3);
  const MassProperties mass =
      mass_of(test::transformed(test::scaled(test::sphere(6), axes), turn, {-3, 0.5, 2}));
  const double volume = 4.0 / 3.0 * test::pi * axes.prod();
  // The chords of 81,920 faces cost 1e-4 of the volume and 2e-4 of a moment.
  EXPECT_NEAR(mass.volume / volume, 1.0, 2e-4);
  EXPECT_LT((mass.centroid - Vector3(-3, 0.5, 2)).norm(), 1e-9);
  const Vector3 square = axes.cwiseAbs2();
  const Vector3 expected(volume / 5.0 * (square[0] + square[1]),
                         volume / 5.0 * (square[0] + square[2]),
                         volume / 5.0 * (square[1] + square[2]));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(mass.principal_moments[k] / expected[k], 1.0, 4e-4);
  // x along the longest axis, which was z.
  EXPECT_NEAR(std::abs((mass.principal_axes * Vector3::UnitX()).dot(turn.col(2))), 1.0, 1e-9);
  EXPECT_NEAR(std::abs((mass.principal_axes * Vector3::UnitZ()).dot(turn.col(0))), 1.0, 1e-9);
}

TEST(MassProperties, PrincipalFrameMakesTheTensorDiagonal) {
  const MassProperties mass = mass_of(uneven_body());
  const Eigen::Matrix3d turn = mass.principal_axes.toRotationMatrix();
  EXPECT_NEAR(turn.determinant(), 1.0, 1e-12);
  EXPECT_GE(mass.principal_axes.w(), 0.0);
  Eigen::Matrix3d turned = turn.transpose() * mass.inertia_tensor * turn;
  EXPECT_LE(mass.principal_moments[0], mass.principal_moments[1]);
  EXPECT_LE(mass.principal_moments[1], mass.principal_moments[2]);
  turned.diagonal() -= mass.principal_moments;
  EXPECT_LT(turned.norm(), 1e-12 * mass.inertia_tensor.norm());
}

// The frame belongs to the body: wherever it lies, and at whatever size.
TEST(MassProperties, FrameTurnsAndMovesWithTheBody) {
  const IndexedMesh body = uneven_body();
  const MassProperties mass = mass_of(body);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Eigen::Matrix3d turn = test::random_rotation(seed);
    const double scale = seed % 2 == 0 ? 1e-3 : 40.0;
    const Vector3 shift = scale * Vector3(5, -2, 1);
    const MassProperties moved = mass_of(test::transformed(body, scale * turn, shift));
    EXPECT_LT(angle_between(moved.principal_axes, Eigen::Quaterniond(turn) * mass.principal_axes),
              1e-7);
    // Of the two quaternions of a turn it is always the same one.
    EXPECT_GE(moved.principal_axes.w(), 0.0);
    EXPECT_LT((moved.centroid - (scale * turn * mass.centroid + shift)).norm(), 1e-11 * scale);
    EXPECT_LT((moved.principal_moments / std::pow(scale, 5) - mass.principal_moments).norm(),
              1e-10);
  }
}

TEST(MassProperties, AxesPointToWhereTheBodyReachesFarther) {
  // A cone lies deeper on the side of its tip: along its axis the third moment has that sign.
  IndexedMesh cone;
  constexpr int sides = 64;
  for (int i = 0; i < sides; ++i) {
    const double t = 2.0 * test::pi * i / sides;
    cone.points.emplace_back(0.0, 0.6 * std::cos(t), 0.5 * std::sin(t));
  }
  cone.points.emplace_back(0.0, 0.0, 0.0);
  for (const double tip : {4.0, -4.0}) {
    IndexedMesh mesh = cone;
    mesh.points.emplace_back(tip, 0.0, 0.0);
    for (std::int32_t i = 0; i < sides; ++i) {
      const std::int32_t next = (i + 1) % sides;
      const bool ahead = tip > 0.0;
      mesh.triangles.push_back(ahead ? Triangle{i, next, sides + 1} : Triangle{next, i, sides + 1});
      mesh.triangles.push_back(ahead ? Triangle{next, i, sides} : Triangle{i, next, sides});
    }
    const MassProperties mass = mass_of(mesh);
    EXPECT_GT((mass.principal_axes * Vector3::UnitX()).x() * tip, 0.0) << tip;
    // On the axes across it is symmetric: the largest component is positive.
    EXPECT_NEAR((mass.principal_axes * Vector3::UnitY()).y(), 1.0, 1e-6) << tip;
  }
}

TEST(MassProperties, AxesOfASymmetricBodyHaveTheirLargestComponentPositive) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const MassProperties mass =
        mass_of(test::transformed(test::box(3, 2, 1), test::random_rotation(seed), {4, 5, 6}));
    for (const Vector3& axis : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY())}) {
      const Vector3 turned = mass.principal_axes * axis;
      EXPECT_EQ(turned.maxCoeff(), turned.cwiseAbs().maxCoeff()) << seed;
    }
  }
}

// Of components that differ only by rounding the first is positive.
TEST(MassProperties, AxesBetweenTwoOfTheMeshsPointAlongTheFirst) {
  for (const double rounding : {-1e-11, 1e-11}) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.75 * test::pi + rounding, Vector3::UnitZ()).toRotationMatrix();
    const MassProperties mass = mass_of(test::transformed(test::box(3, 2, 1), turn));
    const Vector3 longest = mass.principal_axes * Vector3::UnitX();
    EXPECT_NEAR(longest.x(), std::sqrt(0.5), 1e-6) << rounding;
    EXPECT_NEAR(longest.y(), -std::sqrt(0.5), 1e-6) << rounding;
  }
}

/// Integral of (axis . (x - centroid))^3 over a body, of the tetrahedra that its faces span with
/// the centroid, by a rule of five points that is exact to the third degree (Keast 1986,
/// "Moderate-degree tetrahedral quadrature formulas").
double third_moment(const IndexedMesh& mesh, const Vector3& centroid, const Vector3& axis) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3 a = mesh.points[t[0]] - centroid;
    const Vector3 b = mesh.points[t[1]] - centroid;
    const Vector3 c = mesh.points[t[2]] - centroid;
    const auto cube = [&axis](const Vector3& p) { return std::pow(axis.dot(p), 3.0); };
    sum += a.cross(b).dot(c) / 6.0 *
           (-0.8 * cube((a + b + c) / 4.0) +
            0.45 * (cube((a + b + c) / 6.0) + cube((3.0 * a + b + c) / 6.0) +
                    cube((a + 3.0 * b + c) / 6.0) + cube((a + b + 3.0 * c) / 6.0)));
  }
  return sum;
}

TEST(MassProperties, AxesOfRandomBodiesPointByTheirThirdMoments) {
  std::mt19937_64 engine(test::announced(31));
  std::uniform_real_distribution<double> radius(0.4, 1.6);
  for (int round = 0; round < 2000; ++round) {
    IndexedMesh mesh = test::icosahedron();
    for (Vector3& p : mesh.points) p *= radius(engine);
    const MassProperties mass = mass_of(mesh);
    for (const Vector3& axis : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY())}) {
      EXPECT_GT(third_moment(mesh, mass.centroid, mass.principal_axes * axis), -1e-12) << round;
    }
  }
}

}  // namespace
}  // namespace wscvt
