// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/harmonic_grid.h"

#include <cmath>
#include <cstdlib>

#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {

namespace {

HarmonicTransform transform_of(int degree, int rows, const Execution& execution) {
  const std::vector<double> cosines = gauss_legendre(rows).nodes;
  std::vector<double> sines;
  sines.reserve(cosines.size());
  for (const double z : cosines) sines.push_back(std::sqrt((1.0 - z) * (1.0 + z)));
  return {degree, cosines, sines, 2 * rows, execution};
}

}  // namespace

HarmonicGrid::HarmonicGrid(int degree, int rows)
    : one_thread_(1), transform_(transform_of(degree, rows, one_thread_)) {
  const GaussLegendre latitudes = gauss_legendre(rows);
  const std::vector<Eigen::Vector2d> circle = azimuth_circle(2 * rows);
  directions_.reserve(latitudes.nodes.size() * circle.size());
  weights_.reserve(directions_.capacity());
  for (std::size_t row = 0; row < latitudes.nodes.size(); ++row) {
    const double z = latitudes.nodes[row];
    const double sine = std::sqrt((1.0 - z) * (1.0 + z));
    for (const Eigen::Vector2d& p : circle) directions_.emplace_back(sine * p.x(), sine * p.y(), z);
    weights_.insert(weights_.end(), circle.size(), latitudes.weights[row] * pi / rows);
  }
}

std::vector<double> HarmonicGrid::values(const std::vector<double>& coefficients) const {
  return transform_.synthesize(coefficients, one_thread_);
}

std::vector<double> HarmonicGrid::coefficients(std::vector<double> values) const {
  for (std::size_t k = 0; k < values.size() && k < weights_.size(); ++k) values[k] *= weights_[k];
  return transform_.analyze(values, one_thread_);
}

RadialMoments radial_moments(const HarmonicGrid& grid, const std::vector<double>& radii) {
  RadialMoments moments;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const double r = radii[k];
    const Vector3& u = grid.directions()[k];
    const double cube = grid.weights()[k] * r * r * r;
    moments.volume += cube / 3.0;
    moments.centroid += cube * r / 4.0 * u;
    moments.covariance += cube * r * r / 5.0 * u * u.transpose();
  }
  moments.centroid /= moments.volume;
  moments.covariance /= moments.volume;
  moments.covariance -= moments.centroid * moments.centroid.transpose();
  return moments;
}

std::vector<double> degree_amplitudes(const std::vector<double>& coefficients) {
  std::vector<double> amplitudes;
  for (std::size_t l = 0; l * l < coefficients.size(); ++l) {
    double sum = 0.0;
    for (std::size_t k = l * l; k < (l + 1) * (l + 1); ++k) {
      sum += coefficients[k] * coefficients[k];
    }
    amplitudes.push_back(std::sqrt(sum));
  }
  return amplitudes;
}

int mirror_class(int l, int m) {
  const int order = std::abs(m);
  const bool is_sine = m < 0;
  const bool odd_in_x = (order % 2 == 1) != is_sine;
  const bool odd_in_z = (l + order) % 2 == 1;
  return (odd_in_x ? 1 : 0) + (is_sine ? 2 : 0) + (odd_in_z ? 4 : 0);
}

std::vector<double> mirrored(std::vector<double> coefficients, const Vector3& signs) {
  for (int l = 0; harmonic_count(l) <= coefficients.size(); ++l) {
    for (int m = -l; m <= l; ++m) {
      const int odd = mirror_class(l, m);
      for (int axis = 0; axis < 3; ++axis) {
        if ((odd >> axis & 1) != 0) coefficients[harmonic_index(l, m)] *= signs[axis];
      }
    }
  }
  return coefficients;
}

}  // namespace wscvt
