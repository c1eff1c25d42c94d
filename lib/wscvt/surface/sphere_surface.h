// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

using Matrix3 = Eigen::Matrix3d;

/// Order of the derivatives to compute.
enum class Derivatives { None, First, Second };

/// Principal curvatures, positive where the surface is convex: maximum >= minimum. Unit 1/length.
struct PrincipalCurvatures {
  double maximum = 0.0;
  double minimum = 0.0;
};

/// The shape of a surface in a direction, in numbers that do not depend on coordinates. A radial
/// surface computes them without derivatives of the coordinates.
struct LocalShape {
  double distance = 0.0;           ///< |x|, length; the radius if the surface is radial
  double area_element = 0.0;       ///< g = dA/dOmega, length^2; from First on, else 0
  PrincipalCurvatures curvatures;  ///< with Second, else 0
};

/// The point of a surface in the direction u, with its derivatives on the unit sphere.
///
/// All derivatives are derivatives of the degree-0 homogeneous extension x(p) = x(p/|p|), taken at
/// |p| = 1, in Cartesian coordinates of the sphere. So jacobian * u = 0, and jacobian * e is the
/// derivative along a tangent e of the sphere.
struct SurfaceJet {
  Vector3 position = Vector3::Zero();  ///< x, length
  Matrix3 jacobian = Matrix3::Zero();  ///< row i: gradient of coordinate i; length per radian
  /// Hessian of each coordinate; length per radian^2. e^T hessians[i] e is the second derivative of
  /// coordinate i along the great circle in direction e.
  std::array<Matrix3, 3> hessians{Matrix3::Zero(), Matrix3::Zero(), Matrix3::Zero()};
};

/// A closed surface over the unit sphere: a point x(u) for every unit vector u. Examples are a
/// radial surface x = r u (RadialSurface, which also returns radii), a scan with a spherical
/// parametrization (MappedSurface) and a series for each coordinate (HarmonicMap).
class SphereSurface {
 public:
  virtual ~SphereSurface() = default;

  /// Computes positions and derivatives for `count` unit vectors. Fields beyond `derivatives` stay
  /// zero. Must be callable from several threads at once. The value for a direction must not depend
  /// on the other directions in the call.
  virtual void evaluate_jets(const Vector3* directions, std::size_t count, Derivatives derivatives,
                             SurfaceJet* jets) const = 0;

  /// Computes positions only, for `count` unit vectors. The default calls `evaluate_jets`.
  virtual void evaluate_positions(const Vector3* directions, std::size_t count,
                                  Vector3* positions) const;

  /// Computes distance from the origin, area element and curvatures, up to the order `derivatives`,
  /// for `count` unit vectors. Follows the rules of `evaluate_jets`, which the default calls.
  virtual void evaluate_shapes(const Vector3* directions, std::size_t count,
                               Derivatives derivatives, LocalShape* shapes) const;

  /// Like `evaluate_jets`, for a whole array and on the threads of `execution`.
  std::vector<SurfaceJet> surface_jets(const std::vector<Vector3>& directions,
                                       Derivatives derivatives, const Execution& execution) const;

  /// Like `evaluate_positions`, for a whole array and on the threads of `execution`.
  std::vector<Vector3> positions(const std::vector<Vector3>& directions,
                                 const Execution& execution) const;

  /// Like `evaluate_shapes`, but only distances from the origin; length.
  std::vector<double> distances(const std::vector<Vector3>& directions,
                                const Execution& execution) const;
};

/// Returns the normal of the surface at direction u. Its length is the surface's area per solid
/// angle, g = dA/dOmega in length^2. It is outward if the map keeps the orientation. Needs first
/// derivatives.
Vector3 area_normal(const SurfaceJet& jet, const Vector3& direction);

/// Returns the area of the surface per solid angle, g = dA/dOmega; length^2.
double area_element(const SurfaceJet& jet, const Vector3& direction);

/// Returns the outward unit normal; zero if g is zero.
Vector3 surface_normal(const SurfaceJet& jet, const Vector3& direction);

/// Returns the principal curvatures at direction u from a jet with second derivatives: the
/// eigenvalues of the shape operator in the first fundamental form. A sphere of radius R gives 1/R
/// twice, a flat face of a mesh 0. Not finite if g is zero.
PrincipalCurvatures principal_curvatures(const SurfaceJet& jet, const Vector3& direction);

/// Integrals over the body that a surface encloses.
struct BodyIntegrals {
  double volume = 0.0;                 ///< length^3; negative if the map is inside out
  double area = 0.0;                   ///< length^2
  Vector3 centroid = Vector3::Zero();  ///< of the volume; zero if there is no volume
};

/// Computes the integrals by Gauss-Legendre x trapezoid quadrature on the sphere, with
/// `polar_nodes` rows and twice as many columns. For series, the volume is exact if the rows are at
/// least 1.5 times the degree, the centroid if they are at least twice the degree. Throws
/// Error(InvalidInput) if polar_nodes < 1.
BodyIntegrals body_integrals(const SphereSurface& surface, int polar_nodes,
                             const Execution& execution);

/// Returns a surface as a mesh, with points in the directions of subdivided_sphere(frequency).
/// Throws as subdivided_sphere and as the surface.
IndexedMesh mesh_of_surface(const SphereSurface& surface, int frequency,
                            const Execution& execution);

/// Distances and area elements, one value per direction.
struct AreaElements {
  std::vector<double> distances;  ///< |x|, length; the radii if the surface is radial
  std::vector<double> elements;   ///< dA/dOmega, see area_element; length^2
};

/// Computes both in `directions`, unit vectors, and stores no jets. Throws as the surface, and
/// Error(Cancelled).
AreaElements area_elements(const SphereSurface& surface, const std::vector<Vector3>& directions,
                           const Execution& execution);

/// Returns the area of a surface by the quadrature of body_integrals, without normals; length^2.
/// Throws Error(InvalidInput) if polar_nodes < 1.
double surface_area(const SphereSurface& surface, int polar_nodes, const Execution& execution);

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

/// A star-shaped surface about the origin, x(u) = r(u) u for every unit vector u. The published
/// method is for such surfaces. Only functions that need one radius per direction use this class:
/// the fit of the series, cells moved along rays, nodes fitted along rays, roughness and Sdq as
/// printed.
class RadialSurface : public SphereSurface {
 public:
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

  /// Calls `evaluate`.
  void evaluate_jets(const Vector3* directions, std::size_t count, Derivatives derivatives,
                     SurfaceJet* jets) const override;
  /// Calls `evaluate_radii`.
  void evaluate_positions(const Vector3* directions, std::size_t count,
                          Vector3* positions) const override;
  /// Calls `evaluate`, or `evaluate_radii` if radii are enough.
  void evaluate_shapes(const Vector3* directions, std::size_t count, Derivatives derivatives,
                       LocalShape* shapes) const override;
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
