// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/option.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// Ellipsoid (x/a)^2 + (y/b)^2 + (z/c)^2 = 1 with analytic derivatives.
class Ellipsoid : public RadialSurface {
 public:
  /// Semi-axes in length units, each > 0 and finite, else Error(InvalidInput).
  explicit Ellipsoid(const Vector3& semi_axes);

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override;

 private:
  Vector3 semi_axes_;
};

inline constexpr NumberOption<double> polar_exponent_option = {
    "polar-exponent", "polar exponent of the superellipsoid", 0.1, 2.0};
inline constexpr NumberOption<double> azimuthal_exponent_option = {
    "azimuthal-exponent", "azimuthal exponent of the superellipsoid", polar_exponent_option.minimum,
    polar_exponent_option.maximum};

/// Superellipsoid (|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) = 1 (Barr 1981,
/// "Superquadrics and angle-preserving transformations", IEEE Comput. Graph. Appl. 1 (1), 11-23),
/// with e1 = `polar_exponent`, e2 = `azimuthal_exponent`; both 1 give the ellipsoid, values near 0
/// a box. Derivatives are analytic. Second derivatives do not exist on the coordinate planes if an
/// exponent exceeds 1, nor at the poles if e1 is 1 and e2 is not. There the values are finite but
/// have no meaning.
class Superellipsoid : public RadialSurface {
 public:
  /// Semi-axes in length units, each > 0 and finite, exponents 0.1 to 2, else Error(InvalidInput).
  Superellipsoid(const Vector3& semi_axes, double polar_exponent, double azimuthal_exponent);

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override;

 private:
  Vector3 semi_axes_;
  double polar_exponent_;
  double azimuthal_exponent_;
};

}  // namespace wscvt
