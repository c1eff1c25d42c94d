// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_transform.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/sphere/sphere_grid.h"

namespace wscvt {

// The sums are written out, term by term: Eigen's product of two matrices adds in an order, and on
// Arm in fused steps, that depend on the processor.

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rows per block of the azimuthal sums.
constexpr std::size_t row_block = 32;

/// Grid rows per degree in the search for the smallest radius. A series has no dip narrower than
/// half a wavelength, pi / degree; eight rows find its bottom to 2 % of its depth.
constexpr int dip_rows_per_degree = 8;
constexpr int smallest_dip_grid = 32;

Eigen::Index signed_index(std::size_t value) { return static_cast<Eigen::Index>(value); }

/// Returns the column of the azimuthal functions of order m: cosine, then (for m > 0) sine.
Eigen::Index first_column(int m) { return m > 0 ? 2 * m - 1 : 0; }

}  // namespace

std::vector<Eigen::Vector2d> azimuth_circle(int count) {
  std::vector<Eigen::Vector2d> circle;
  circle.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * pi * k / count;
    circle.emplace_back(portable::cos(angle), portable::sin(angle));
  }
  return circle;
}

HarmonicTransform::HarmonicTransform(int degree, const std::vector<double>& cosines,
                                     const std::vector<double>& sines, int azimuths,
                                     const Execution& execution)
    : degree_(degree), rows_(signed_index(cosines.size())), azimuths_(azimuths) {
  if (degree < 0 || degree > maximum_harmonic_degree || azimuths < 1 ||
      cosines.size() != sines.size()) {
    refuse("A harmonic transform needs a degree from 0 to " +
           std::to_string(maximum_harmonic_degree) +
           ", at least one azimuth and as many sines as cosines. It was given degree " +
           std::to_string(degree) + ", " + std::to_string(azimuths) + " azimuths, " +
           std::to_string(cosines.size()) + " cosines and " + std::to_string(sines.size()) +
           " sines.");
  }
  // The angles of all orders are among the azimuths. Their indices are reduced as integers, so that
  // equal angles get equal bits.
  const std::vector<Eigen::Vector2d> circle = azimuth_circle(azimuths);
  trigonometric_.resize(azimuths_, 2 * degree + 1);
  for (Eigen::Index k = 0; k < azimuths_; ++k) {
    trigonometric_(k, 0) = 1.0;
    for (int m = 1; m <= degree; ++m) {
      const auto turn = static_cast<std::size_t>((k * m) % azimuths_);
      trigonometric_(k, first_column(m)) = circle[turn].x();
      trigonometric_(k, first_column(m) + 1) = circle[turn].y();
    }
  }
  legendre_.resize(static_cast<std::size_t>(degree) + 1);
  execution.parallel_for_each(legendre_.size(), 1, [&](std::size_t order) {
    const int m = static_cast<int>(order);
    legendre_[order].resize(rows_, degree + 1 - m);
    associated_legendre(degree, m, cosines.data(), sines.data(), cosines.size(),
                        legendre_[order].data());
  });
}

std::vector<double> HarmonicTransform::synthesize(const std::vector<double>& coefficients,
                                                  const Execution& execution) const {
  if (coefficients.size() != harmonic_count(degree_)) {
    refuse("The harmonic transform of degree " + std::to_string(degree_) + " needs " +
           std::to_string(harmonic_count(degree_)) + " coefficients, not " +
           std::to_string(coefficients.size()) + ".");
  }
  Eigen::MatrixXd orders = Eigen::MatrixXd::Zero(rows_, 2 * degree_ + 1);
  execution.parallel_for_each(legendre_.size(), 4, [&](std::size_t order) {
    const int m = static_cast<int>(order);
    for (int l = m; l <= degree_; ++l) {
      const auto along = legendre_[order].col(l - m);
      orders.col(first_column(m)) += coefficients[harmonic_index(l, m)] * along;
      if (m > 0) orders.col(first_column(m) + 1) += coefficients[harmonic_index(l, -m)] * along;
    }
  });
  std::vector<double> values(rows() * azimuths());
  Eigen::Map<RowMajor> grid(values.data(), rows_, azimuths_);
  execution.parallel_for(rows(), row_block, [&](std::size_t begin, std::size_t end) {
    for (Eigen::Index j = signed_index(begin); j < signed_index(end); ++j) {
      for (Eigen::Index c = 0; c < orders.cols(); ++c) {
        grid.row(j) += orders(j, c) * trigonometric_.col(c).transpose();
      }
    }
  });
  return values;
}

std::vector<double> HarmonicTransform::analyze(const std::vector<double>& values,
                                               const Execution& execution) const {
  if (values.size() != rows() * azimuths()) {
    refuse("The harmonic transform on a grid of " + std::to_string(rows()) + " x " +
           std::to_string(azimuths()) + " needs as many values, not " +
           std::to_string(values.size()) + ".");
  }
  const Eigen::Map<const RowMajor> grid(values.data(), rows_, azimuths_);
  const RowMajor by_azimuth = trigonometric_;
  RowMajor orders = RowMajor::Zero(rows_, 2 * degree_ + 1);
  execution.parallel_for(rows(), row_block, [&](std::size_t begin, std::size_t end) {
    for (Eigen::Index j = signed_index(begin); j < signed_index(end); ++j) {
      for (Eigen::Index k = 0; k < azimuths_; ++k) {
        orders.row(j) += grid(j, k) * by_azimuth.row(k);
      }
    }
  });
  std::vector<double> coefficients(harmonic_count(degree_));
  execution.parallel_for_each(legendre_.size(), 4, [&](std::size_t order) {
    const int m = static_cast<int>(order);
    for (int l = m; l <= degree_; ++l) {
      const auto sum = [&, along = legendre_[order].col(l - m)](Eigen::Index column) {
        double result = 0.0;
        for (Eigen::Index j = 0; j < rows_; ++j) result += along(j) * orders(j, column);
        return result;
      };
      coefficients[harmonic_index(l, m)] = sum(first_column(m));
      if (m > 0) coefficients[harmonic_index(l, -m)] = sum(first_column(m) + 1);
    }
  });
  return coefficients;
}

double smallest_radius(const HarmonicSurface& surface, const Execution& execution) {
  const int rows = std::max(smallest_dip_grid, dip_rows_per_degree * surface.degree());
  const HarmonicTransform transform(surface.degree(), SphereGrid::row_cosines(rows),
                                    SphereGrid::row_sines(rows), 2 * rows, execution);
  const std::vector<double> radii = transform.synthesize(surface.coefficients(), execution);
  return *std::min_element(radii.begin(), radii.end());
}

}  // namespace wscvt
