// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/pi.h"
#include "wscvt/surface/spherical_harmonics.h"

/// The fit by its definition, in time points * coefficients^2: what the library's is held against.
namespace wscvt::test {

/// The weighted least squares solved directly, and its weighted rms residual.
struct PlainFit {
  Eigen::VectorXd coefficients;
  double residual;
};

inline PlainFit plain_least_squares(const std::vector<Vector3>& directions,
                                    const std::vector<double>& radii,
                                    const std::vector<double>& weights, int degree) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto width = static_cast<Eigen::Index>(harmonic_count(degree));
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(width, width);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(width);
  const std::size_t block = 500;
  const auto each_block = [&](const auto& visit) {
    for (std::size_t begin = 0; begin < radii.size(); begin += block) {
      const std::size_t count = std::min(block, radii.size() - begin);
      const auto size = static_cast<Eigen::Index>(count);
      const std::vector<double> values = harmonic_values(degree, directions.data() + begin, count);
      visit(Eigen::Map<const Rows>(values.data(), size, width),
            Eigen::Map<const Eigen::VectorXd>(weights.data() + begin, size),
            Eigen::Map<const Eigen::VectorXd>(radii.data() + begin, size));
    }
  };
  each_block([&](const auto& basis, const auto& w, const auto& r) {
    const Eigen::MatrixXd scaled = (w.cwiseSqrt().asDiagonal() * basis).transpose();
    normal.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
    right += basis.transpose() * w.cwiseProduct(r);
  });
  PlainFit result;
  result.coefficients = normal.selfadjointView<Eigen::Lower>().llt().solve(right);
  double sum = 0.0;
  double weight_sum = 0.0;
  each_block([&](const auto& basis, const auto& w, const auto& r) {
    sum += w.dot((r - basis * result.coefficients).cwiseAbs2());
    weight_sum += w.sum();
  });
  result.residual = std::sqrt(sum / weight_sum);
  return result;
}

/// Root mean square over the sphere of the difference of two series of the same degree.
inline double rms_difference(const std::vector<double>& a, const Eigen::VectorXd& b) {
  const Eigen::Map<const Eigen::VectorXd> mapped(a.data(), static_cast<Eigen::Index>(a.size()));
  return (mapped - b).norm() / std::sqrt(4.0 * pi);
}

}  // namespace wscvt::test
