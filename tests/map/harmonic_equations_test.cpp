// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/harmonic_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "support/seeds.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {
namespace {

/// Weights of sum 4 pi that go up and down by a factor of 19 within a few degrees.
std::vector<double> uneven_weights(const std::vector<Vector3>& directions) {
  std::vector<double> weights;
  double sum = 0.0;
  for (const Vector3& u : directions) {
    weights.push_back(1.0 + 0.9 * std::sin(37.0 * u.x() + 11.0 * u.y()));
    sum += weights.back();
  }
  for (double& weight : weights) weight *= 4.0 * pi / sum;
  return weights;
}

/// A row for each direction.
Eigen::MatrixXd basis_at(const std::vector<Vector3>& directions, int degree) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::vector<double> values = harmonic_values(degree, directions.data(), directions.size());
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(directions.size()),
                                    static_cast<Eigen::Index>(harmonic_count(degree)));
}

TEST(HarmonicEquations, OfManyPointsGiveWhatPlainLeastSquaresDo) {
  // As many waves in values and weights as the grid holds: where it interpolates worst.
  constexpr int degree = 30;
  const std::vector<Vector3> directions = random_directions(4000, test::announced(71));
  const WeightedDirections points{directions, uneven_weights(directions)};
  std::vector<double> series;
  for (const Vector3& u : random_directions(static_cast<int>(harmonic_count(degree)), 72)) {
    series.push_back(u.x());
  }
  const Eigen::VectorXd values =
      basis_at(directions, degree) *
      Eigen::Map<const Eigen::VectorXd>(series.data(), static_cast<Eigen::Index>(series.size()));

  const auto equations = harmonic_equations(points, degree, Execution(1));
  equations->set_degree(degree, Execution(1));
  const HarmonicLeastSquares fit = least_squares(
      *equations, points, {values.data(), values.data() + values.size()}, degree, Execution(1));
  ASSERT_TRUE(fit.converged);

  const Eigen::VectorXd roots =
      Eigen::Map<const Eigen::VectorXd>(points.weights.data(), values.size()).cwiseSqrt();
  const Eigen::MatrixXd basis = basis_at(directions, degree);
  // The weighted basis is nearly orthogonal, so that its normal equations lose no digits.
  const Eigen::MatrixXd weighted = roots.asDiagonal() * basis;
  const Eigen::VectorXd plain = (weighted.transpose() * weighted)
                                    .llt()
                                    .solve(weighted.transpose() * roots.cwiseProduct(values));
  const Eigen::VectorXd off =
      Eigen::Map<const Eigen::VectorXd>(fit.coefficients.data(), plain.size()) - plain;
  // 3e-6; 5e-5 without the second pass.
  EXPECT_LT(off.norm(), 1e-5 * plain.norm());
}

}  // namespace
}  // namespace wscvt
