// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// Radius of a star-shaped surface in one direction u, with its derivatives on the unit sphere.
///
/// Both derivatives are those of the degree-0 homogeneous extension r(x) = r(x/|x|), taken at
/// |x| = 1, in Cartesian coordinates. So `gradient` is tangential (gradient . u = 0) and equals
/// grad_Omega r; `hessian` is symmetric, its tangential block is the covariant Hessian on the
/// sphere, and hessian * u = -gradient.
struct RadialJet {
  double radius = 0.0;                 ///< length units of the surface, > 0
  Vector3 gradient = Vector3::Zero();  ///< length units per radian
  Matrix3 hessian = Matrix3::Zero();   ///< length units per radian^2
};

/// A star-shaped surface about the origin, x(u) = r(u) u for every unit vector u: the case of a
/// surface over the sphere that the published method is for. What works on radii, its weights by
/// distance and its fit of one number a node, asks for radii; three numbers for one would cost it
/// its speed.
class RadialSurface : public SphereSurface {
 public:
  /// Radii and derivatives for `count` unit vectors. Fields beyond `derivatives` are left at zero.
  /// Must be callable from several threads at once, and the value for a direction must not depend
  /// on what other directions stand in the same call.
  virtual void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                        RadialJet* jets) const = 0;

  /// Radii only, for `count` unit vectors. The default goes through `evaluate`.
  virtual void evaluate_radii(const Vector3* directions, std::size_t count, double* radii) const;

  /// As `evaluate`, for a whole array and on the threads of `execution`.
  std::vector<RadialJet> jets(const std::vector<Vector3>& directions, Derivatives derivatives,
                              const Execution& execution) const;

  /// As `evaluate_radii`, for a whole array and on the threads of `execution`.
  std::vector<double> radii(const std::vector<Vector3>& directions,
                            const Execution& execution) const;

  /// Radius in one direction, a unit vector; length.
  double radius(const Vector3& direction) const;

  /// From `evaluate`.
  void evaluate_jets(const Vector3* directions, std::size_t count, Derivatives derivatives,
                     SurfaceJet* jets) const override;
  /// From `evaluate_radii`.
  void evaluate_positions(const Vector3* directions, std::size_t count,
                          Vector3* positions) const override;
};

/// Surface area per solid angle, g = dA/dOmega = r sqrt(r^2 + |grad_Omega r|^2); length^2.
inline double area_element(const RadialJet& jet) {
  return jet.radius * std::sqrt(jet.radius * jet.radius + jet.gradient.squaredNorm());
}

/// Outward unit normal of x(u) = r(u) u at direction u, along r u - grad_Omega r.
Vector3 surface_normal(const RadialJet& jet, const Vector3& direction);

/// Principal curvatures at direction u from a jet with second derivatives: the shape operator of
/// the level set |x| - r(x/|x|) = 0. A sphere of radius R gives 1/R twice.
PrincipalCurvatures principal_curvatures(const RadialJet& jet, const Vector3& direction);

/// Extends the tangential derivatives of any smooth extension f of r near |x| = 1 to a RadialJet:
/// given f's Cartesian gradient and Hessian at u, projects out their radial parts.
RadialJet jet_from_extension(double radius, const Vector3& gradient, const Matrix3& hessian,
                             const Vector3& direction);

/// The same without second derivatives, which are zero in the result: for Derivatives::First.
/// Inline, as area_element is: what tabulates a surface calls both tens of thousands of times.
inline RadialJet jet_from_extension(double radius, const Vector3& gradient,
                                    const Vector3& direction) {
  RadialJet jet;
  jet.radius = radius;
  jet.gradient = gradient - gradient.dot(direction) * direction;
  return jet;
}

/// Integrals over a radial surface about its origin, by Gauss-Legendre x trapezoid quadrature.
struct SurfaceIntegrals {
  double volume = 0.0;                 ///< length^3
  double area = 0.0;                   ///< length^2
  Vector3 centroid = Vector3::Zero();  ///< of the enclosed volume; length
  double gradient_square = 0.0;        ///< integral of |grad_Omega r|^2 dOmega, length^2
};

/// Computes the integrals with `polar_nodes` Gauss-Legendre nodes in cos(theta) and twice as many
/// in azimuth; exact for series of degree below polar_nodes / 3. Throws Error(InvalidInput) if
/// polar_nodes < 1.
SurfaceIntegrals integrate(const RadialSurface& surface, int polar_nodes,
                           const Execution& execution);

/// The same on grids of 200, 400, 800 and 1600 polar nodes, until volume and area change by at most
/// 1e-5 of themselves from one to the next, or by 1e-4 to the last (sharp edges converge slowly).
/// Throws Error(InvalidInput) when they do not, as for discs of more than about 20 : 1, and when
/// the surface encloses no volume about its origin.
SurfaceIntegrals integrate(const RadialSurface& surface, const Execution& execution);

}  // namespace wscvt
