// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/radial_surface.h"

namespace wscvt {

/// A star-shaped surface given by a series of real orthonormal spherical harmonics,
/// r(u) = sum a_lm Y_lm(u) (the paper, eqs. 1 to 5; see spherical_harmonics.h for the convention).
class HarmonicSurface : public RadialSurface {
 public:
  /// `coefficients`: (degree + 1)^2 values in length units, a_lm at index l^2 + l + m. Throws
  /// Error(InvalidInput) when the number is not a square or a value is not finite.
  explicit HarmonicSurface(std::vector<double> coefficients);

  int degree() const { return degree_; }
  const std::vector<double>& coefficients() const { return coefficients_; }

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override;
  void evaluate_radii(const Vector3* directions, std::size_t count, double* radii) const override;

 private:
  std::vector<double> coefficients_;
  int degree_;
};

/// How the fit went.
struct HarmonicFitReport {
  int requested_degree = 0;
  int degree = 0;                ///< lowered when the points cannot carry the requested one
  std::size_t points = 0;        ///< that entered the fit
  double residual = 0.0;         ///< weighted rms of r_i - r(u_i), length
  double condition = 0.0;        ///< condition estimate of the weighted normal equations
  double smallest_radius = 0.0;  ///< of the series on a fine grid, > 0
};

struct HarmonicFit {
  HarmonicSurface surface;
  HarmonicFitReport report;
};

/// Weighted least-squares fit of a series to samples (u_i, r_i) with weights w_i > 0 (solid angles,
/// any scale). The degree is lowered until the points carry it. Throws Error(InvalidInput) for
/// arrays of different lengths, degree < 0 or > 60, no points; Error(NumericalFailure) when the
/// series is not positive everywhere at any degree.
HarmonicFit fit_harmonics(const std::vector<Vector3>& directions, const std::vector<double>& radii,
                          const std::vector<double>& weights, int degree,
                          const Execution& execution);

}  // namespace wscvt
