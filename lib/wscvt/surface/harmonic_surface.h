// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/radial_surface.h"
#include "wscvt/surface/surface_options.h"

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

/// Largest degree of the harmonics; accuracy is tested up to 60.
constexpr int maximum_harmonic_degree = 200;

/// Returns the index of Y_lm in an array of coefficients: l^2 + l + m, for -l <= m <= l.
constexpr std::size_t harmonic_index(int l, int m) {
  const int index = l * l + l + m;
  return static_cast<std::size_t>(index);
}

/// Number of harmonics up to a degree: (degree + 1)^2.
constexpr std::size_t harmonic_count(int degree) {
  return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 1);
}

/// A series f(u) = sum a_lm Y_lm(u), arranged for fast sums in many directions without a stored
/// basis. The sum uses the Cartesian form Y_lm = Q_lm(z) Re or Im (x + iy)^m with
/// Q_lm = P_lm / sin^m theta and dQ_lm/dz proportional to Q_l,m+1, which is regular at the poles.
class HarmonicSeries {
 public:
  /// `coefficients`: (degree + 1)^2 values in the order of `harmonic_index`. Throws
  /// Error(InvalidInput) if their number is not a square or the degree is above
  /// maximum_harmonic_degree.
  explicit HarmonicSeries(const std::vector<double>& coefficients);

  int degree() const { return degree_; }

  /// Computes f in `count` directions (unit vectors). A value does not depend on the other
  /// directions.
  void sum(const Vector3* directions, std::size_t count, double* values) const;

  /// Computes f and its derivatives as in RadialJet, up to the order `derivatives`.
  void sum(const Vector3* directions, std::size_t count, Derivatives derivatives,
           RadialJet* jets) const;

  /// The factors of Q_lm in the sums, and its recurrence from the two terms before it with equal m.
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
  /// Error(InvalidInput) if there are no values, their number is not a square, the degree is above
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
/// of closed surfaces for 3-D shape description"). Grains with overhangs also have such series.
class HarmonicMap {
 public:
  /// `coefficients` of x, y and z: (degree + 1)^2 values each in length units, a_lm at index
  /// l^2 + l + m. Throws Error(InvalidInput) if there are no values, their numbers differ or are no
  /// square, the degree is above maximum_harmonic_degree, or a value is not finite.
  explicit HarmonicMap(std::array<std::vector<double>, 3> coefficients);

  int degree() const { return series_[0].degree(); }
  const std::array<std::vector<double>, 3>& coefficients() const { return coefficients_; }

  /// Returns the points x(u) in `directions`, unit vectors.
  std::vector<Vector3> positions(const std::vector<Vector3>& directions,
                                 const Execution& execution) const;

 private:
  std::array<std::vector<double>, 3> coefficients_;
  std::array<HarmonicSeries, 3> series_;
};

/// Returns the surface as a mesh, with points in the directions of subdivided_sphere(frequency).
/// Throws as subdivided_sphere.
IndexedMesh mesh_of_surface(const HarmonicMap& map, int frequency, const Execution& execution);

/// Returns the series of the radius of a closed scan about the origin, in its units (see
/// fit_harmonics); without coefficients if rays from the origin do not see all of the scan (see
/// overhang_solid_angle). Throws Error: InvalidInput for a degree out of range, NumericalFailure,
/// Cancelled.
SeriesCoefficients radial_coefficients(const IndexedMesh& scan, int degree,
                                       const Execution& execution);

// Files of such surfaces. All functions below throw Error(InputOutput) if the file cannot be
// opened, read or written. They throw Error(InvalidInput), naming the file and the line, if the
// file contains no such surface: wrong syntax, a coefficient missing or given twice, a radius that
// is not real and positive everywhere, or a map that encloses no volume or is inside out. Files
// are written completely or not at all, see write_file.

/// A star-shaped surface or a map.
using HarmonicShape = std::variant<HarmonicSurface, HarmonicMap>;

/// Reads a file by its ending: .dat by read_complex_harmonics, .sh by read_shtools, else
/// read_harmonics, for which `degree` has no meaning.
HarmonicShape read_coefficients(const std::string& path, int degree = -1);

/// Reads the text form of the NIST particle shape sets (VCCTL, THAMES): lines `n m Re Im`, the
/// coefficients of complex orthonormal harmonics with the Condon-Shortley phase, in any order.
/// Coefficients with m < 0 follow from those with m > 0 and may be left out. If present, they must
/// agree to 1e-6 of the largest coefficient. `degree` >= 0 cuts the series there, as the tables
/// beside the sets do; -1 keeps all.
HarmonicSurface read_complex_harmonics(const std::string& path, int degree = -1);

/// Reads a file of SHTOOLS or pyshtools: rows `l, m, C, S` for m >= 0, with commas or blanks. The
/// radius is the sum of (C cos(m phi) + S sin(m phi)) P_lm(cos theta). The harmonics are SHTOOLS'
/// default: real, normalized so that their mean square over the sphere is 1 ("4pi"), without the
/// Condon-Shortley phase (csphase 1). The file does not contain its normalization. Convert others
/// first by pyshtools: coeffs.convert(normalization="4pi", csphase=1). Our a_l,m = (-1)^m sqrt(4
/// pi) C, a_l,-m = (-1)^m sqrt(4 pi) S (M. Wieczorek, M. Meschede, 2018, "SHTools: tools for
/// working with spherical harmonics"). `degree` as above.
HarmonicSurface read_shtools(const std::string& path, int degree = -1);

/// Writes such a file, with all digits of each number.
void write_shtools(const std::string& path, const HarmonicSurface& surface);

/// Reads a file of the functions below. A file without "kind" is a radial series.
HarmonicShape read_harmonics(const std::string& path);

/// Writes {"format": "wscvt-harmonics-1", "kind": "radial", "degree": L, "coefficients": [...]}:
/// real orthonormal harmonics as above, a_lm at index l^2 + l + m. Reading returns the same bits.
void write_harmonics(const std::string& path, const HarmonicSurface& surface);

/// Writes the same with "kind": "map" and "coefficients": {"x": [...], "y": [...], "z": [...]}.
void write_harmonic_map(const std::string& path, const HarmonicMap& map);

}  // namespace wscvt
