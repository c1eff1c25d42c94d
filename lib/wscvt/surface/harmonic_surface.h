// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "wscvt/base/option.h"
#include "wscvt/surface/radial_surface.h"
#include "wscvt/surface/spherical_harmonics.h"

namespace wscvt {

/// A star-shaped surface given by a series of real orthonormal spherical harmonics,
/// r(u) = sum a_lm Y_lm(u) (the paper, eqs. 1 to 5; see spherical_harmonics.h for the convention).
class HarmonicSurface : public RadialSurface {
 public:
  /// `coefficients`: (degree + 1)^2 values in length units, a_lm at index l^2 + l + m. Throws
  /// Error(InvalidInput) when there are none, their number is not a square, the degree is above
  /// maximum_harmonic_degree (200), or a value is not finite.
  explicit HarmonicSurface(std::vector<double> coefficients);

  int degree() const { return series_.degree(); }
  const std::vector<double>& coefficients() const { return coefficients_; }

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override;
  void evaluate_radii(const Vector3* directions, std::size_t count, double* radii) const override;

 private:
  std::vector<double> coefficients_;
  HarmonicSeries series_;
};

/// Smallest radius of the series on an equal-angle grid of eight rows a degree (32 at least),
/// length; a surface that is not positive everywhere is not star-shaped about the origin.
double smallest_radius(const HarmonicSurface& surface, const Execution& execution);

}  // namespace wscvt
