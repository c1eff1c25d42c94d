// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/star_shape.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

namespace wscvt {
namespace {

StarShape shape_of(const std::vector<Vector3>& vectors) {
  return star_shape([&](const auto& visit) {
    for (const Vector3& vector : vectors) visit(vector, vector.norm());
  });
}

TEST(StarShape, RimShareIsNoneOnASheetAndAllOverBoth) {
  EXPECT_EQ(rim_share(1.0), 0.0);
  EXPECT_EQ(rim_share(0.96), 0.0);
  EXPECT_EQ(rim_share(0.6), 1.0);
  EXPECT_EQ(rim_share(0.0), 1.0);
  EXPECT_GT(rim_share(0.75), rim_share(0.85));
}

TEST(StarShape, KnowsTheRimsDirection) {
  const Vector3 along = Vector3(0.3, -0.7, 0.2).normalized();
  const Vector3 up = along.unitOrthogonal();
  const Vector3 out = along.cross(up);
  const StarShape shape = shape_of({0.2 * out - up, 0.2 * out + up});
  EXPECT_EQ(shape.rim, 1.0);
  EXPECT_NEAR(shape.normal.dot(out), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(shape.along.dot(along)), 1.0, 1e-12);
  EXPECT_NEAR(shape.tangential(up).norm(), 0.0, 1e-12);
  EXPECT_NEAR((shape.tangential(along + out) - along).norm(), 0.0, 1e-12);
}

TEST(StarShape, FindsTheLeastDirectionOfAnyTensor) {
  constexpr unsigned seed = 5;
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 6; ++k) {
      const Vector3 normal(number(random), number(random), number(random));
      tensor += normal * normal.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
    const Vector3 values = solver.eigenvalues();
    if (values[0] > 0.7 * values[1]) continue;  // each squaring squares the ratio: .7^32 = 1e-5
    EXPECT_NEAR(std::abs(least_direction(tensor).dot(solver.eigenvectors().col(0))), 1.0, 1e-9);
  }
}

TEST(StarShape, OfSheetsOnOneAnotherMovesInTheirPlane) {
  const Vector3 up = Vector3(0.3, 0.5, -0.8).normalized();
  const StarShape shape = shape_of({up, -up, 2.0 * up});
  EXPECT_EQ(shape.rim, 1.0);
  EXPECT_NEAR(shape.along.norm(), 1.0, 1e-12);
  EXPECT_NEAR(shape.along.dot(up), 0.0, 1e-12);
}

TEST(StarShape, OfASheetMovesAlongIt) {
  const Vector3 up(0.0, 0.0, 2.0);
  const StarShape shape = shape_of({up, 3.0 * up});
  EXPECT_EQ(shape.rim, 0.0);
  EXPECT_LT((shape.tangential(Vector3(1.0, 2.0, 5.0)) - Vector3(1.0, 2.0, 0.0)).norm(), 1e-15);
  EXPECT_EQ(shape_of({Vector3::Zero()}).normal, Vector3::UnitZ());
}

}  // namespace
}  // namespace wscvt
