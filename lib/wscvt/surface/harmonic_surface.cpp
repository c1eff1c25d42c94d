// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {

namespace {

/// Grid rows per degree on which the smallest radius is looked for: a series has no dip narrower
/// than half a wavelength, pi / degree, and eight rows see its bottom to 2 % of its depth.
constexpr int rows_per_degree = 8;
constexpr int smallest_grid = 32;

}  // namespace

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

double smallest_radius(const HarmonicSurface& surface, const Execution& execution) {
  const int rows = std::max(smallest_grid, rows_per_degree * surface.degree());
  const HarmonicTransform transform(surface.degree(), SphereGrid::row_cosines(rows),
                                    SphereGrid::row_sines(rows), 2 * rows, execution);
  const std::vector<double> radii = transform.synthesize(surface.coefficients(), execution);
  return *std::min_element(radii.begin(), radii.end());
}

}  // namespace wscvt
