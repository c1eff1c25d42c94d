// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {

/// Converts functions on the sphere between values on a Gauss-Legendre grid and harmonics up to a
/// degree. All functions may be called from several threads.
class HarmonicGrid {
 public:
  /// `rows` latitudes and twice as many azimuths. Throws Error(InvalidInput) for rows < 1 and a
  /// degree that HarmonicTransform refuses.
  HarmonicGrid(int degree, int rows);

  int degree() const { return transform_.degree(); }
  const std::vector<Vector3>& directions() const { return directions_; }
  /// Returns the solid angles of the directions; they sum to 4 pi.
  const std::vector<double>& weights() const { return weights_; }

  /// Returns the values of the series in the directions. Throws as HarmonicTransform.
  std::vector<double> values(const std::vector<double>& coefficients) const;
  /// Returns the projection onto the harmonics, exact below degree 2 rows - degree().
  std::vector<double> coefficients(std::vector<double> values) const;

 private:
  Execution one_thread_;
  HarmonicTransform transform_;
  std::vector<Vector3> directions_;
  std::vector<double> weights_;
};

/// Moments of the solid r(u) u whose radii are given in the directions of a grid.
struct RadialMoments {
  double volume = 0.0;                                   ///< length^3
  Vector3 centroid = Vector3::Zero();                    ///< length
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the volume about it; length^2
};
RadialMoments radial_moments(const HarmonicGrid& grid, const std::vector<double>& radii);

/// Returns the amplitude of each degree of a series: the root of the sum of its squared
/// coefficients, in their unit.
std::vector<double> degree_amplitudes(const std::vector<double>& coefficients);

/// Returns the series of f(s u), s a mirror image: signs of 1 or -1 for x, y and z.
std::vector<double> mirrored(std::vector<double> coefficients, const Vector3& signs);

/// Returns the mirror class of a harmonic, 0 to 7: bit 0 if it is odd in x, bit 1 in y, bit 2 in z.
int mirror_class(int l, int m);

}  // namespace wscvt
