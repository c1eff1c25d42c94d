// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

// Surfaces given by spherical harmonics, and files of them.
//
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

/// A star-shaped surface given by a series of real orthonormal spherical harmonics,
/// r(u) = sum a_lm Y_lm(u) (the paper, eqs. 1 to 5).
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

/// A closed surface of genus 0 given by a series of real orthonormal spherical harmonics for each
/// coordinate, x(u) = sum of a_lm Y_lm(u) (Brechbuehler, Gerig and Kuebler 1995, "Parametrization
/// of closed surfaces for 3-D shape description").
/// Shells and hooks have such series, and smooth curvatures with them.
class HarmonicMap : public SphereSurface {
 public:
  /// `coefficients` of x, y and z: (degree + 1)^2 values each in length units, a_lm at index
  /// l^2 + l + m. Throws Error(InvalidInput) when there are none, their numbers differ or are no
  /// square, the degree is above maximum_harmonic_degree, or a value is not finite.
  explicit HarmonicMap(std::array<std::vector<double>, 3> coefficients);

  int degree() const { return series_[0].degree(); }
  const std::array<std::vector<double>, 3>& coefficients() const { return coefficients_; }

  void evaluate_jets(const Vector3* directions, std::size_t count, Derivatives derivatives,
                     SurfaceJet* jets) const override;

 private:
  std::array<std::vector<double>, 3> coefficients_;
  std::array<HarmonicSeries, 3> series_;
};

// Files of such surfaces. All of these throw Error(InputOutput) when the file cannot be opened,
// read or written, and Error(InvalidInput), naming the file and the line, when what it holds is not
// such a surface: wrong syntax, a coefficient missing or given twice, a radius that is not real and
// positive everywhere.

/// Reads the text form of the NIST particle shape sets (VCCTL, THAMES): lines `n m Re Im`, the
/// coefficients of complex orthonormal harmonics with the Condon-Shortley phase, in any order.
/// Those with m < 0 follow from those with m > 0 and may be left out; where given they must agree
/// to 1e-6 of the largest. `degree` >= 0 cuts the series there, as the tables beside the sets do;
/// -1 keeps all.
HarmonicSurface read_complex_harmonics(const std::string& path, int degree = -1);

/// Content of a file of `write_harmonics` or `write_harmonic_map` holds.
enum class HarmonicKind {
  Radial,  ///< one series, of the radius
  Map,     ///< three, of x, y and z over the map to the sphere
};

/// Returns the kind that a file holds; Radial if it has no "kind".
HarmonicKind read_harmonic_kind(const std::string& path);

/// Reads what `write_harmonics` writes. A file without "kind" is taken for a radial one.
HarmonicSurface read_harmonics(const std::string& path);

/// Writes {"format": "wscvt-harmonics-1", "kind": "radial", "degree": L, "coefficients": [...]}:
/// real orthonormal harmonics as above, a_lm at place l^2 + l + m. Reading gives
/// the same bits back. Written whole or not at all, see write_file.
void write_harmonics(const std::string& path, const HarmonicSurface& surface);

/// Reads what `write_harmonic_map` writes. Refuses series that enclose no volume or are turned
/// inside out.
HarmonicMap read_harmonic_map(const std::string& path);

/// As `write_harmonics`, with "kind": "map" and "coefficients": {"x": [...], "y": [...], "z":
/// [...]}.
void write_harmonic_map(const std::string& path, const HarmonicMap& map);

}  // namespace wscvt
