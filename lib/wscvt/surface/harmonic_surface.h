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

/// Degree of a series to be fitted; 0 is a sphere.
inline constexpr NumberOption<int> fit_degree_option = {"degree", "degree of the fit", 0, 60};
/// Of one that stands for a grain.
inline constexpr NumberOption<int> harmonic_degree_option = {
    "degree",   "harmonic degree",
    1,          fit_degree_option.maximum,
    Ends::Both, "of the series fitted to the scan; lowered when the scan cannot carry it"};

/// Why a series has a lower degree than was asked for.
enum class DegreeLimit {
  None,       ///< it has the degree asked for
  Points,     ///< fewer than two points a coefficient
  Condition,  ///< the points are spread too unevenly to tell the coefficients apart
  Radius,  ///< of higher degree the series is not positive everywhere: a long, flat or sharp body
};

template <>
struct EnumerationTable<DegreeLimit> {
  static constexpr std::string_view key = "degree-limit";
  static constexpr std::string_view subject = "limit of the degree";
  static constexpr Enumerator<DegreeLimit> rows[] = {
      {DegreeLimit::None, "none", "as asked for"},
      {DegreeLimit::Points, "points", "the points carry no more"},
      {DegreeLimit::Condition, "condition", "the points are spread too unevenly for more"},
      {DegreeLimit::Radius, "radius", "above it the series is not positive everywhere"},
  };
};

/// How the fit went.
struct HarmonicFitReport {
  int requested_degree = 0;
  int degree = 0;  ///< lowered when the points cannot carry the requested one
  DegreeLimit limit = DegreeLimit::None;
  std::size_t points = 0;        ///< that entered the fit
  double residual = 0.0;         ///< weighted rms of r_i - r(u_i), length
  double condition = 0.0;        ///< condition estimate of the weighted normal equations
  double smallest_radius = 0.0;  ///< of the series on a fine grid, > 0
};

struct HarmonicFit {
  HarmonicSurface surface;
  HarmonicFitReport report;
};

/// Weighted least-squares fit of a series to samples (u_i, r_i), r_i > 0, with weights w_i > 0
/// (solid angles, any scale), as the paper's eq. 5.
///
/// The degree is lowered until the points carry it: at least two points a coefficient, a condition
/// of the normal equations of at most 1000, and a series that is positive on a fine grid. From
/// about two thousand points on, the equations are formed from moments gathered on a grid, in time
/// linear in the points; the result is that of the plain sums to well within 1e-3 of the residual.
///
/// Throws Error(InvalidInput) for arrays of different lengths, a degree out of range, no points, or
/// a point that is not as above; Error(NumericalFailure) when the series is not positive everywhere
/// at any degree.
HarmonicFit fit_harmonics(const std::vector<Vector3>& directions, const std::vector<double>& radii,
                          const std::vector<double>& weights, int degree,
                          const Execution& execution);

/// A report in lengths of `unit`, in plain lengths.
void scale(HarmonicFitReport& report, double unit);

}  // namespace wscvt
