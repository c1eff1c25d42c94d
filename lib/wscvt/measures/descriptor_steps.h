// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// A body's volume, and the integral of x^3 dV along each of two axes from its centroid.
struct AxisMoments {
  double volume = 0.0;
  Eigen::Vector2d third = Eigen::Vector2d::Zero();

  AxisMoments& operator+=(const AxisMoments& other) {
    volume += other.volume;
    third += other.third;
    return *this;
  }
};

/// Returns the unit quaternion q that turns the principal axes into the mesh's axes: a point p of
/// the principal frame is centroid + q p in the mesh's frame. Programs choose differently among the
/// 24 possible frames. Here the body determines the frame:
/// - Order: moments ascend, so x is along the longest axis and z along the shortest.
/// - Sign: x and y point to where the body reaches farther, by the third moment of its volume along
///   them, integral of x^3 dV >= 0, so the frame does not depend on the pose. If the body is
///   symmetric along an axis, the axis's largest component in the mesh's frame (the first of
///   several) is positive, which depends on the pose. z completes a right-handed frame.
/// - q has w >= 0.
/// If moments are equal, as for a sphere or a cube, the axes are arbitrary.
///
/// `inertia_tensor` as in ShapeDescriptors. `moments_along` returns the body's moments along axes,
/// which are the columns.
Eigen::Quaterniond principal_axes(
    const Eigen::Matrix3d& inertia_tensor,
    const std::function<AxisMoments(const Eigen::Matrix<double, 3, 2>& axes)>& moments_along);

/// Computes the edges of the smallest-volume oriented box about the points. Minimizes, over the
/// directions of one edge (smallest_over_directions), the extent along it times the area of the
/// smallest rectangle about the points seen along it (smallest_rectangle). The volume is within 0.1
/// % of the smallest and equal in every pose. A search in the given pose, by the optimisation of
/// Chang, Gorissen and Melchior (2011, ACM Trans. Graph. 30, 122; CGAL::oriented_bounding_box),
/// gave axes that changed by 1.2 % when a body was turned. The search begins with the extreme
/// points of 200 and 2,000 directions and ends with all points. The edges bound all points. Give
/// the points of the convex hull. Throws Error(InvalidInput) for fewer than four points,
/// coordinates that are not finite or extents not between 1e-60 and 1e60; Error(Cancelled). Uses
/// one thread.
FormAxes oriented_box_axes(const std::vector<Vector3>& points,
                           const Execution& execution = Execution(1));

/// Computes the ratios of dimensions > 0. Throws nothing.
FormRatios form_ratios(const FormAxes& axes);

/// Computes the tensor. Throws Error(InvalidInput) if the mesh has no area.
OrientationTensor orientation_tensor(const IndexedMesh& mesh, const Execution& execution);

/// Computes the diameters of a closed mesh, in its unit of length, with its convex hull.
///
/// The largest Feret diameter is exact up to 4,000 points of the hull. For more points, two extreme
/// points of 2,000 directions are found and moved to the farthest of all points. The smallest is a
/// width across a face of the hull or between two of its edges (Houle and Toussaint 1988,
/// "Computing the width of a set", IEEE Trans. Pattern Anal. Mach. Intell. 10, 761-765). It is the
/// best of all faces, and of directions followed downhill from the best faces and by
/// smallest_over_directions. W and T are chords between points of the body's surface, as Taylor,
/// Garboczi et al. (2006, "Some properties of irregular 3-D particles", Powder Technol. 162, 1-15)
/// define them, not widths of its shadow. W is the longest chord in a plane perpendicular to L (128
/// planes; the best is then moved). T is the longest chord perpendicular to both (on lines of a 128
/// by 128 lattice). For the series of three NIST particles, chords agree within 5 % with their
/// published W and T, widths of the shadow within 23 %.
///
/// Throws Error(InvalidInput) for fewer than four points, Error(Cancelled).
FeretDiameters feret_diameters(const IndexedMesh& mesh, const IndexedMesh& hull,
                               const Execution& execution);

/// Returns the integral of the mean curvature (k1 + k2) / 2 over a closed mesh: half the sum over
/// its edges of length times the angle between the normals, positive at ridges (Steiner's formula).
/// For a convex body it is 2 pi times the mean Feret diameter. Length.
double mean_curvature_integral(const IndexedMesh& mesh, const Execution& execution);

/// Finds the largest sphere inside a closed mesh; Wadell's roundness refers to its radius (see
/// wadell_roundness). A branch-and-bound search on cubes finds the point farthest from the surface.
/// It uses exact point-to-triangle distances, which change no faster than the point moves. Points
/// that a sphere touches bound all distances about its centre. Stops if upper_bound <= 1.001
/// radius, or after 50,000 distances (for bodies with a broad plateau, such as a plate with
/// parallel faces). Throws Error(InvalidInput) if the mesh has no faces or nothing inside.
InscribedSphere largest_inscribed_sphere(const IndexedMesh& mesh, const Execution& execution);

/// Computes roundness after Wadell (1932, "Volume, shape, and roundness of rock particles", J.
/// Geol. 40, 443-451): mean radius of the corners over the radius R of the largest inscribed
/// sphere. In two dimensions Zheng and Hryciw (2015, Geotechnique 65, 494-506) fit circles to the
/// corners of an outline. In three, Nie et al. (2018, "A new roundness index based on local
/// curvature", Powder Technol. 335, 58-66) use curvature, as does this library.
///
/// Convention: corners are the points whose larger principal curvature k exceeds 1.05 / R. The mean
/// over them weights each radius 1/k by the turn k dA that it makes:
///   V = A_c / (R integral over the corners of k dA),   A_c their area.
/// Another weight gives another number: an ellipsoid 1 : 2 : 6 has 0.54 by turn, 0.61 by area. A
/// rounded cube of edge radius a has V = a / R for any weight.
///
/// Curvature in balls of radius s (ball_curvatures) conserves the turn but spreads a corner over
/// the ball, so V(s) grows linearly with s. Hence
///   V = V(s) - 2 (V(1.5 s) - V(s)),   at least V(s) - 0.7 (s / R) (1 - V(s)).
/// If corners cover less than 1 % of the area, roundness is 1.
///
/// `ball` is s / R in (0, 1]; s is at least 2.5 mean edges of the mesh. The smallest corner radius
/// that can be distinguished from sharper corners, to within 0.03 R, is s / 4 (measured on cubes of
/// edge radius 0.02 to 1 at 1,000 to 20,000 vertices). If s / R exceeds 1, roundness is NaN.
/// Measures at most 5,000 places, chosen at random with a fixed seed, one in each equal part of the
/// area. On seven scans this changes roundness by at most 0.006. The order of the faces and
/// vertices does not matter; rotations of three scans changed it by at most 0.009. Works on any
/// closed body.
///
/// Throws Error(InvalidInput) if the inscribed radius or the ball is not positive.
Roundness wadell_roundness(const IndexedMesh& mesh, double inscribed_radius, double ball,
                           const Execution& execution);

/// Measures roughness above the mesh without its short waves, in two passes of SurfaceLowPass. B =
/// p(h) X filters the vertices X in the metric of X. The heights are z = (X - B) . n along the
/// normals n of B. The second pass filters X in the metric of X - z n, which the roughness no
/// longer lengthens; with one pass, 4 % of steep waves are lost. Works on any closed body, also
/// with overhangs. If Sq is below 1e-12 of `cutoff`, the surface counts as smooth, and Ssk and Sku
/// are 0.
///
/// `cutoff` > 0, length: longer waves are form. Throws Error(InvalidInput) if the cut-off is not
/// positive or below least_cutoff(mesh), because the edges are then too long for such waves.
Roughness surface_roughness(const IndexedMesh& mesh, double cutoff, const Execution& execution);

/// Returns the least cut-off length that surface_roughness accepts for a mesh: three times the
/// area-weighted mean length of the faces' edges.
double least_cutoff(const IndexedMesh& mesh);

/// Computes Sdq as the paper prints it (eq. 17): ((1/A) integral over theta in [0, pi] and phi in
/// [0, 2 pi] of (r_theta^2 + r_phi^2) dtheta dphi)^(1/2), theta the polar angle about z. No unit.
/// It changes if a grain is rotated, because the meridians crowd at the poles: by 1 to 12 % over
/// four poses of the grains in meshes/, fitted at degree 20 (tests/figures/study/README.md,
/// roughness.csv). ShapeDescriptors::sdq does not change. Midpoint rule on `rings` parallels of 2
/// `rings` azimuths; area by the same rule. Throws Error(InvalidInput) if rings < 1.
double printed_sdq(const RadialSurface& surface, int rings, const Execution& execution);

}  // namespace wscvt
