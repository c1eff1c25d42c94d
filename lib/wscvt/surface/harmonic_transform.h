// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

/// Returns the cosine and sine of each of `count` azimuths phi_k = 2 pi k / count.
std::vector<Eigen::Vector2d> azimuth_circle(int count);

/// Computes sums of a series on a grid of parallels, and their transpose, in (degree) rather than
/// (degree)^2 operations per node: Legendre functions along the rows, sines and cosines along the
/// azimuth.
///
/// The grid has one row per latitude and `azimuths` columns phi_k = 2 pi k / azimuths. Values are
/// row by row. Coefficients are in the order of `harmonic_index`.
class HarmonicTransform {
 public:
  /// `cosines`, `sines`: cos(theta) and sin(theta) of the rows. Throws Error(InvalidInput) if their
  /// lengths differ, the degree is not in [0, maximum_harmonic_degree], or azimuths < 1.
  HarmonicTransform(int degree, const std::vector<double>& cosines,
                    const std::vector<double>& sines, int azimuths, const Execution& execution);

  int degree() const { return degree_; }
  std::size_t rows() const { return static_cast<std::size_t>(rows_); }
  std::size_t azimuths() const { return static_cast<std::size_t>(azimuths_); }

  /// values[j, k] = sum over (l, m) of coefficients[l, m] Y_lm(theta_j, phi_k). Throws
  /// Error(InvalidInput) unless there are (degree + 1)^2 coefficients.
  std::vector<double> synthesize(const std::vector<double>& coefficients,
                                 const Execution& execution) const;

  /// coefficients[l, m] = sum over (j, k) of values[j, k] Y_lm(theta_j, phi_k): the transpose,
  /// without weights. Throws Error(InvalidInput) unless there are rows x azimuths values.
  std::vector<double> analyze(const std::vector<double>& values, const Execution& execution) const;

 private:
  int degree_;
  Eigen::Index rows_;
  Eigen::Index azimuths_;
  Eigen::MatrixXd trigonometric_;  ///< azimuths x (2 degree + 1): 1, then cosine, sine of m phi
  std::vector<Eigen::MatrixXd> legendre_;  ///< of every m: rows x (degree + 1 - m)
};

/// Returns the smallest radius of the series on an equal-angle grid of eight rows per degree (at
/// least 32), length. If a radius is not positive, the surface is not star-shaped about the origin.
double smallest_radius(const HarmonicSurface& surface, const Execution& execution);

/// Returns the values of all harmonics up to `degree` for `count` unit vectors: (degree + 1)^2
/// values per direction, in the order of `harmonic_index`. Throws Error(InvalidInput) if the degree
/// is not in [0, maximum_harmonic_degree].
std::vector<double> harmonic_values(int degree, const Vector3* directions, std::size_t count);

/// Computes sqrt(2 - delta_m0) P_lm(cos theta) for l = m ... degree on a set of latitudes,
/// latitudes innermost: values[(l - m) * count + j]. `sines[j]` = sin theta_j >= 0 is a separate
/// argument because it keeps its digits near the poles. Throws Error(InvalidInput) if the degree is
/// not in [0, maximum_harmonic_degree] or m is not in [0, degree].
void associated_legendre(int degree, int m, const double* cosines, const double* sines,
                         std::size_t count, double* values);

}  // namespace wscvt
