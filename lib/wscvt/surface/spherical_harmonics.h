// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/surface/radial_surface.h"

namespace wscvt {

// Real orthonormal spherical harmonics with the Condon-Shortley phase (the paper, eqs. 3 and 4,
// whose text leaves out the azimuth of Y in eq. 2). With the normalised associated Legendre
// function
//   P_lm(z) = (-1)^m sqrt((2l+1)/(4 pi) (l-m)!/(l+m)!) (1-z^2)^(m/2) d^m P_l(z)/dz^m,  m >= 0,
// they are
//   Y_l,0  = P_l0(cos theta),
//   Y_l,m  = sqrt(2) P_lm(cos theta) cos(m phi),    m > 0,
//   Y_l,-m = sqrt(2) P_lm(cos theta) sin(m phi),    m > 0,
// so Y_1,1 = -sqrt(3/(4 pi)) x, Y_1,-1 = -sqrt(3/(4 pi)) y, Y_1,0 = sqrt(3/(4 pi)) z, and the
// integral of Y_lm Y_l'm' over the sphere is 1 for equal indices, else 0. In terms of the complex
// orthonormal harmonics with the same phase, Y_l,m = sqrt(2) Re Y_l^m and Y_l,-m = sqrt(2) Im
// Y_l^m.

/// Largest degree the harmonics are computed for; accuracy is tested up to 60.
constexpr int maximum_harmonic_degree = 200;

/// Place of Y_lm in an array of coefficients: l^2 + l + m, for -l <= m <= l.
constexpr std::size_t harmonic_index(int l, int m) {
  const int index = l * l + l + m;
  return static_cast<std::size_t>(index);
}

/// Number of harmonics up to a degree: (degree + 1)^2.
constexpr std::size_t harmonic_count(int degree) {
  return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 1);
}

/// Values of all harmonics up to `degree` for `count` unit vectors: (degree + 1)^2 of them a
/// direction, in the order of `harmonic_index`, one direction after another. Throws
/// Error(InvalidInput) when the degree is not in [0, maximum_harmonic_degree].
std::vector<double> harmonic_values(int degree, const Vector3* directions, std::size_t count);

/// sqrt(2 - delta_m0) P_lm(cos theta) for l = m ... degree on a set of latitudes, latitudes
/// innermost: values[(l - m) * count + j]. `sines[j]` = sin theta_j >= 0 is given apart from
/// `cosines[j]` to keep its digits near the poles. Throws Error(InvalidInput) when the degree is
/// not in [0, maximum_harmonic_degree] or m not in [0, degree].
void associated_legendre(int degree, int m, const double* cosines, const double* sines,
                         std::size_t count, double* values);

/// A series f(u) = sum a_lm Y_lm(u), laid out for summing it in many directions without storing the
/// basis. It is summed in the Cartesian form Y_lm = Q_lm(z) Re or Im (x + iy)^m with
/// Q_lm = P_lm / sin^m theta and dQ_lm/dz proportional to Q_l,m+1, which is regular at the poles.
class HarmonicSeries {
 public:
  /// `coefficients`: (degree + 1)^2 values in the order of `harmonic_index`. Throws
  /// Error(InvalidInput) when their number is not a square or the degree is above
  /// maximum_harmonic_degree.
  explicit HarmonicSeries(const std::vector<double>& coefficients);

  int degree() const { return degree_; }

  /// f in `count` directions (unit vectors); the value for one does not depend on the others.
  void sum(const Vector3* directions, std::size_t count, double* values) const;

  /// f with the derivatives RadialJet describes, filled in as far as `derivatives` says.
  void sum(const Vector3* directions, std::size_t count, Derivatives derivatives,
           RadialJet* jets) const;

  /// What Q_lm stands in front of, and how it follows from the two before it at the same m.
  struct Term {
    double alpha, beta;  ///< Q_lm = alpha z Q_l-1,m - beta Q_l-2,m; alpha = Q_mm at l = m
    double value[2];     ///< cosine and sine factors of f
    double first[2];     ///< of df/dz, whose order is m - 1
    double second[2];    ///< of d2f/dz2, whose order is m - 2
  };

 private:
  int degree_;
  std::vector<Term> terms_;  ///< by m, then l = m ... degree
};

}  // namespace wscvt
