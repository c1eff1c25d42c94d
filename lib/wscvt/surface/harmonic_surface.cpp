// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

HarmonicSurface::HarmonicSurface(std::vector<double> coefficients)
    : coefficients_(std::move(coefficients)), series_(coefficients_) {
  for (std::size_t k = 0; k < coefficients_.size(); ++k) {
    if (!std::isfinite(coefficients_[k])) {
      throw Error(ErrorCode::InvalidInput, "Coefficient " + std::to_string(k) +
                                               " of the spherical-harmonic series is not a finite "
                                               "number.");
    }
  }
}

void HarmonicSurface::evaluate(const Vector3* directions, std::size_t count,
                               Derivatives derivatives, RadialJet* jets) const {
  series_.sum(directions, count, derivatives, jets);
}

void HarmonicSurface::evaluate_radii(const Vector3* directions, std::size_t count,
                                     double* radii) const {
  series_.sum(directions, count, radii);
}

HarmonicMap::HarmonicMap(std::array<std::vector<double>, 3> coefficients)
    : coefficients_(std::move(coefficients)),
      series_{HarmonicSeries(coefficients_[0]), HarmonicSeries(coefficients_[1]),
              HarmonicSeries(coefficients_[2])} {
  constexpr std::array<char, 3> names{'x', 'y', 'z'};
  for (std::size_t k = 0; k < 3; ++k) {
    if (coefficients_[k].size() != coefficients_[0].size()) {
      throw Error(ErrorCode::InvalidInput, "The series for x, y and z have " +
                                               std::to_string(coefficients_[0].size()) + ", " +
                                               std::to_string(coefficients_[1].size()) + " and " +
                                               std::to_string(coefficients_[2].size()) +
                                               " coefficients. Give them the same degree.");
    }
    for (std::size_t i = 0; i < coefficients_[k].size(); ++i) {
      if (!std::isfinite(coefficients_[k][i])) {
        throw Error(ErrorCode::InvalidInput, "Coefficient " + std::to_string(i) +
                                                 " of the series for " + names[k] +
                                                 " is not a finite number.");
      }
    }
  }
}

void HarmonicMap::evaluate_jets(const Vector3* directions, std::size_t count,
                                Derivatives derivatives, SurfaceJet* jets) const {
  std::fill(jets, jets + count, SurfaceJet());
  std::vector<RadialJet> coordinate(count);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    series_[k].sum(directions, count, derivatives, coordinate.data());
    for (std::size_t i = 0; i < count; ++i) {
      jets[i].position[row] = coordinate[i].radius;
      if (derivatives == Derivatives::None) continue;
      jets[i].jacobian.row(row) = coordinate[i].gradient.transpose();
      if (derivatives == Derivatives::Second) jets[i].hessians[k] = coordinate[i].hessian;
    }
  }
}

}  // namespace wscvt
