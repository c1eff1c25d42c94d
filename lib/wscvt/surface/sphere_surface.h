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

/// What a surface is like in a direction, in numbers that do not hang on coordinates. Of a radial
/// surface they are had without the coordinates' derivatives.
struct LocalShape {
  double distance = 0.0;           ///< |x|, length; of a radial surface its radius
  double area_element = 0.0;       ///< g = dA/dOmega, length^2; filled in from First on
  PrincipalCurvatures curvatures;  ///< filled in from Second on
};

/// The point of a surface over the direction u, with its derivatives on the unit sphere.
///
/// All derivatives are those of the degree-0 homogeneous extension x(p) = x(p/|p|), taken at
/// |p| = 1, in Cartesian coordinates of the sphere. So jacobian * u = 0, and jacobian * e is the
/// derivative along a tangent e of the sphere.
struct SurfaceJet {
  Vector3 position = Vector3::Zero();  ///< x, length
  Matrix3 jacobian = Matrix3::Zero();  ///< row i: gradient of coordinate i; length per radian
  /// Hessian of each coordinate; length per radian^2. e^T hessians[i] e is the second derivative of
  /// coordinate i along the great circle in direction e.
  std::array<Matrix3, 3> hessians{Matrix3::Zero(), Matrix3::Zero(), Matrix3::Zero()};
};

/// A closed surface spread over the unit sphere: a point x(u) for every unit vector u. A radial
/// surface, x = r u, is one case (RadialSurface), which can be asked for radii as well; a scan
/// mapped to the sphere (MappedSurface), which can be walked on, and a series for each coordinate
/// (HarmonicMap) are others.
class SphereSurface {
 public:
  virtual ~SphereSurface() = default;

  /// Positions and derivatives for `count` unit vectors. Fields beyond `derivatives` are left at
  /// zero. Must be callable from several threads at once, and the value for a direction must not
  /// depend on what other directions stand in the same call.
  virtual void evaluate_jets(const Vector3* directions, std::size_t count, Derivatives derivatives,
                             SurfaceJet* jets) const = 0;

  /// Points only, for `count` unit vectors. The default goes through `evaluate_jets`.
  virtual void evaluate_positions(const Vector3* directions, std::size_t count,
                                  Vector3* positions) const;

  /// Distance from the origin, area element and curvatures, as far as `derivatives` says, for
  /// `count` unit vectors; under the same rules as `evaluate_jets`, through which the default goes.
  virtual void evaluate_shapes(const Vector3* directions, std::size_t count,
                               Derivatives derivatives, LocalShape* shapes) const;

  /// Like `evaluate_jets`, for a whole array and on the threads of `execution`.
  std::vector<SurfaceJet> surface_jets(const std::vector<Vector3>& directions,
                                       Derivatives derivatives, const Execution& execution) const;

  /// Like `evaluate_positions`, for a whole array and on the threads of `execution`.
  std::vector<Vector3> positions(const std::vector<Vector3>& directions,
                                 const Execution& execution) const;

  /// The distances from the origin alone of `evaluate_shapes`, likewise; length.
  std::vector<double> distances(const std::vector<Vector3>& directions,
                                const Execution& execution) const;
};

/// Normal of the surface at direction u, as long as the surface's area per solid angle,
/// g = dA/dOmega in length^2; outward where the map keeps the orientation. From first derivatives.
Vector3 area_normal(const SurfaceJet& jet, const Vector3& direction);

/// Area of the surface per solid angle, g = dA/dOmega; length^2.
double area_element(const SurfaceJet& jet, const Vector3& direction);

/// Outward unit normal; zero where g is.
Vector3 surface_normal(const SurfaceJet& jet, const Vector3& direction);

/// Principal curvatures at direction u from a jet with second derivatives: the eigenvalues of the
/// shape operator in the first fundamental form. A sphere of radius R gives 1/R twice, a flat face
/// of a mesh 0. Not finite where g is zero.
PrincipalCurvatures principal_curvatures(const SurfaceJet& jet, const Vector3& direction);

/// Integrals over the body that a surface encloses.
struct BodyIntegrals {
  double volume = 0.0;                 ///< length^3; negative where the map turns it inside out
  double area = 0.0;                   ///< length^2
  Vector3 centroid = Vector3::Zero();  ///< of the volume; zero without one
};

/// By Gauss-Legendre x trapezoid quadrature on the sphere, with `polar_nodes` rows and twice as
/// many columns; volume and centroid of series are exact from rows of 1.5 and 2 times the degree
/// on. Throws Error(InvalidInput) if polar_nodes < 1.
BodyIntegrals body_integrals(const SphereSurface& surface, int polar_nodes,
                             const Execution& execution);

/// A surface as a mesh, with its points in the directions of subdivided_sphere(frequency). Throws
/// as that, and what the surface throws.
IndexedMesh mesh_of_surface(const SphereSurface& surface, int frequency,
                            const Execution& execution);

/// Distances and area elements, one value a direction.
struct AreaElements {
  std::vector<double> distances;  ///< |x|, length; of a radial surface its radii
  std::vector<double> elements;   ///< dA/dOmega, see area_element; length^2
};

/// Both in `directions`, unit vectors, without keeping a jet of many numbers a direction. Throws
/// what the surface throws, and Error(Cancelled).
AreaElements area_elements(const SphereSurface& surface, const std::vector<Vector3>& directions,
                           const Execution& execution);

/// Area of a surface by the quadrature of body_integrals, which needs no normals; length^2. Throws
/// Error(InvalidInput) if polar_nodes < 1.
double surface_area(const SphereSurface& surface, int polar_nodes, const Execution& execution);

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
/// surface over the sphere that the published method is for. Only what has no meaning without one
/// number a direction asks for it: the fit of the series, cells that are moved along rays, nodes
/// fitted along them, roughness and Sdq as printed.
class RadialSurface : public SphereSurface {
 public:
  /// Radii and derivatives for `count` unit vectors. Fields beyond `derivatives` are left at zero.
  /// Must be callable from several threads at once, and the value for a direction must not depend
  /// on what other directions stand in the same call.
  virtual void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                        RadialJet* jets) const = 0;

  /// Radii only, for `count` unit vectors. The default goes through `evaluate`.
  virtual void evaluate_radii(const Vector3* directions, std::size_t count, double* radii) const;

  /// Like `evaluate`, for a whole array and on the threads of `execution`.
  std::vector<RadialJet> jets(const std::vector<Vector3>& directions, Derivatives derivatives,
                              const Execution& execution) const;

  /// Like `evaluate_radii`, for a whole array and on the threads of `execution`.
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
  /// From `evaluate`, or `evaluate_radii` where that is enough: one number instead of three.
  void evaluate_shapes(const Vector3* directions, std::size_t count, Derivatives derivatives,
                       LocalShape* shapes) const override;
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
