// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/quadric_surface.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

void check_semi_axes(const Vector3& semi_axes) {
  for (int i = 0; i < 3; ++i) {
    if (!(semi_axes[i] > 0.0) || !std::isfinite(semi_axes[i])) {
      refuse("Semi-axis " + std::to_string(i + 1) + " is " + format_number(semi_axes[i]) +
             ". Give three positive lengths.");
    }
  }
}

/// Returns base^exponent for base >= 0. Negative powers use at least a millionth as base.
double bounded_power(double base, double exponent) {
  return portable::pow(exponent < 0.0 ? std::max(base, 1e-6) : base, exponent);
}

double sign(double value) { return value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : 0.0; }

/// Value, gradient and Hessian of F(t) = (|t_x|^p + |t_y|^p)^(q/p) + |t_z|^q.
struct ImplicitJet {
  double value = 0.0;
  Vector3 gradient = Vector3::Zero();
  Matrix3 hessian = Matrix3::Zero();
};

ImplicitJet superellipsoid_function(const Vector3& t, double p, double q) {
  const Vector3 size = t.cwiseAbs();
  const double s = q / p;
  ImplicitJet jet;
  // The larger of the two horizontal coordinates is factored out of the sum, against underflow near
  // the poles. On the axis itself the limit along the diagonal is used.
  const double m = std::max(size.x(), size.y());
  const double x = m > 0.0 ? size.x() / m : 1.0;
  const double y = m > 0.0 ? size.y() / m : 1.0;
  const double sum = portable::pow(x, p) + portable::pow(y, p);
  const double outer = s * portable::pow(sum, s - 1.0);
  const double cross = s * (s - 1.0) * portable::pow(sum, s - 2.0);
  const double dx = p * portable::pow(x, p - 1.0);
  const double dy = p * portable::pow(y, p - 1.0);
  const double first = bounded_power(m, q - 1.0);
  const double second = bounded_power(m, q - 2.0);
  jet.value = portable::pow(m, q) * portable::pow(sum, s) + portable::pow(size.z(), q);
  jet.gradient = {first * outer * dx * sign(t.x()), first * outer * dy * sign(t.y()),
                  q * portable::pow(size.z(), q - 1.0) * sign(t.z())};
  const double ddx = p * (p - 1.0) * bounded_power(x, p - 2.0);
  const double ddy = p * (p - 1.0) * bounded_power(y, p - 2.0);
  jet.hessian(0, 0) = second * (outer * ddx + cross * dx * dx);
  jet.hessian(1, 1) = second * (outer * ddy + cross * dy * dy);
  jet.hessian(0, 1) = second * cross * dx * dy * sign(t.x()) * sign(t.y());
  jet.hessian(1, 0) = jet.hessian(0, 1);
  jet.hessian(2, 2) = q * (q - 1.0) * bounded_power(size.z(), q - 2.0);
  return jet;
}

/// Sets derivatives above the requested order to zero.
RadialJet limited(RadialJet jet, Derivatives derivatives) {
  if (derivatives != Derivatives::Second) jet.hessian.setZero();
  if (derivatives == Derivatives::None) jet.gradient.setZero();
  return jet;
}

}  // namespace

Ellipsoid::Ellipsoid(const Vector3& semi_axes) : semi_axes_(semi_axes) {
  check_semi_axes(semi_axes);
}

void Ellipsoid::evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                         RadialJet* jets) const {
  for (std::size_t i = 0; i < count; ++i) {
    // r = (x^T D x)^(-1/2) with D = diag(1/a^2, 1/b^2, 1/c^2), homogeneous of degree -1.
    const Vector3& u = directions[i];
    const double r = 1.0 / u.cwiseQuotient(semi_axes_).norm();
    // r D x r is of order 1 for any unit of length.
    const Vector3 slope = (r * u.cwiseQuotient(semi_axes_)).cwiseQuotient(semi_axes_) * r;
    const Vector3 inverse_square = (r * semi_axes_.cwiseInverse()).cwiseAbs2();
    const Matrix3 hessian =
        r * (3.0 * slope * slope.transpose() - Matrix3(inverse_square.asDiagonal()));
    jets[i] = limited(jet_from_extension(r, -r * slope, hessian, u), derivatives);
  }
}

Superellipsoid::Superellipsoid(const Vector3& semi_axes, double polar_exponent,
                               double azimuthal_exponent)
    : semi_axes_(semi_axes),
      polar_exponent_(polar_exponent),
      azimuthal_exponent_(azimuthal_exponent) {
  check_semi_axes(semi_axes);
  require_in_range(polar_exponent, polar_exponent_option);
  require_in_range(azimuthal_exponent, azimuthal_exponent_option);
}

void Superellipsoid::evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                              RadialJet* jets) const {
  const double p = 2.0 / azimuthal_exponent_;
  const double q = 2.0 / polar_exponent_;
  for (std::size_t i = 0; i < count; ++i) {
    // r(x) = F(x / semi-axes)^(-1/q), homogeneous of degree -1; F is evaluated with a largest
    // coordinate of 1, so that large powers stay in range.
    const Vector3& u = directions[i];
    const Vector3 relative = u.cwiseQuotient(semi_axes_);
    const double scale = 1.0 / relative.cwiseAbs().maxCoeff();
    const ImplicitJet f = superellipsoid_function(relative * scale, p, q);
    const double r = scale * portable::pow(f.value, -1.0 / q);
    const Vector3 stretch = scale * semi_axes_.cwiseInverse();
    const Vector3 slope = stretch.cwiseProduct(f.gradient) / (q * f.value);
    const Matrix3 bend = stretch.asDiagonal() * f.hessian * stretch.asDiagonal() / (q * f.value);
    const Matrix3 hessian = r * ((1.0 + q) * slope * slope.transpose() - bend);
    jets[i] = limited(jet_from_extension(r, -r * slope, hessian, u), derivatives);
  }
}

}  // namespace wscvt
