// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Order of the derivatives to compute.
enum class Derivatives { None, First, Second };

/// Principal curvatures, positive where the surface is convex: maximum >= minimum. Unit 1/length.
struct PrincipalCurvatures {
  double maximum = 0.0;
  double minimum = 0.0;
};

/// Radius of a star-shaped surface in one direction u, with its derivatives on the unit sphere.
///
/// Both derivatives are derivatives of the degree-0 homogeneous extension r(x) = r(x/|x|), taken at
/// |x| = 1, in Cartesian coordinates. So `gradient` is tangential (gradient . u = 0) and equals
/// grad_Omega r; `hessian` is symmetric, its tangential block is the covariant Hessian on the
/// sphere, and hessian * u = -gradient.
struct RadialJet {
  double radius = 0.0;                 ///< length units of the surface, > 0
  Vector3 gradient = Vector3::Zero();  ///< length units per radian
  Matrix3 hessian = Matrix3::Zero();   ///< length units per radian^2
};

/// A star-shaped surface about the origin, x(u) = r(u) u for every unit vector u.
class RadialSurface {
 public:
  virtual ~RadialSurface() = default;

  /// Computes radii and derivatives for `count` unit vectors. Fields beyond `derivatives` stay
  /// zero. Must be callable from several threads at once. The value for a direction must not depend
  /// on the other directions in the call.
  virtual void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                        RadialJet* jets) const = 0;

  /// Computes radii only, for `count` unit vectors. The default calls `evaluate`.
  virtual void evaluate_radii(const Vector3* directions, std::size_t count, double* radii) const;

  /// Like `evaluate`, for a whole array and on the threads of `execution`.
  std::vector<RadialJet> jets(const std::vector<Vector3>& directions, Derivatives derivatives,
                              const Execution& execution) const;

  /// Like `evaluate_radii`, for a whole array and on the threads of `execution`.
  std::vector<double> radii(const std::vector<Vector3>& directions,
                            const Execution& execution) const;

  /// Returns the radius in one direction, a unit vector; length.
  double radius(const Vector3& direction) const;
};

/// Returns the surface area per solid angle, g = dA/dOmega = r sqrt(r^2 + |grad_Omega r|^2);
/// length^2.
inline double area_element(const RadialJet& jet) {
  return jet.radius * std::sqrt(jet.radius * jet.radius + jet.gradient.squaredNorm());
}

/// Returns the outward unit normal of x(u) = r(u) u at direction u, along r u - grad_Omega r.
Vector3 surface_normal(const RadialJet& jet, const Vector3& direction);

/// Returns the principal curvatures at direction u from a jet with second derivatives: eigenvalues
/// of the shape operator of the level set |x| - r(x/|x|) = 0. A sphere of radius R gives 1/R twice.
PrincipalCurvatures principal_curvatures(const RadialJet& jet, const Vector3& direction);

/// Extends the tangential derivatives of any smooth extension f of r near |x| = 1 to a RadialJet:
/// given f's Cartesian gradient and Hessian at u, projects out their radial parts.
RadialJet jet_from_extension(double radius, const Vector3& gradient, const Matrix3& hessian,
                             const Vector3& direction);

/// The function above without second derivatives, which are zero in the result: for
/// Derivatives::First. Inline, as area_element, because tables of a surface call both tens of
/// thousands of times.
inline RadialJet jet_from_extension(double radius, const Vector3& gradient,
                                    const Vector3& direction) {
  RadialJet jet;
  jet.radius = radius;
  jet.gradient = gradient - gradient.dot(direction) * direction;
  return jet;
}

/// Radii and area elements, one value per direction.
struct AreaElements {
  std::vector<double> radii;     ///< length
  std::vector<double> elements;  ///< dA/dOmega, see area_element; length^2
};

/// Computes both in `directions`, unit vectors, and stores no jets. Throws as the surface, and
/// Error(Cancelled).
AreaElements area_elements(const RadialSurface& surface, const std::vector<Vector3>& directions,
                           const Execution& execution);

/// Returns the area of a surface by the quadrature of `integrate`, without the other integrals;
/// length^2. Throws Error(InvalidInput) if polar_nodes < 1.
double surface_area(const RadialSurface& surface, int polar_nodes, const Execution& execution);

/// Returns a surface as a mesh, with points in the directions of subdivided_sphere(frequency).
/// Throws as subdivided_sphere and as the surface.
IndexedMesh mesh_of_surface(const RadialSurface& surface, int frequency,
                            const Execution& execution);

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

/// Computes the integrals on grids of 200, 400, 800 and 1600 polar nodes. Stops if volume and area
/// change by at most 1e-5 of themselves from one grid to the next, or by 1e-4 to the last grid
/// (sharp edges converge slowly). Throws Error(InvalidInput) if they change more, as for discs of
/// more than about 20 : 1, or if the surface encloses no volume about its origin.
SurfaceIntegrals integrate(const RadialSurface& surface, const Execution& execution);

}  // namespace wscvt
