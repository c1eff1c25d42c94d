// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// A small connected part of a mesh. Three numbers stand for its faces; ball_curvatures reads no
/// others.
struct SurfacePatch {
  Vector3 centre = Vector3::Zero();  ///< centroid; length
  /// Vector area over area: the mean unit normal, shorter than 1 where the patch bends. Zero for a
  /// patch without area.
  Vector3 normal = Vector3::Zero();
  double area = 0.0;  ///< length^2
};

/// The faces of a mesh, grouped into patches.
struct SurfacePatches {
  std::vector<SurfacePatch> patches;
  Groups neighbours;                   ///< of each patch, across edges; each once
  std::vector<std::int32_t> of_faces;  ///< the patch of each face of the mesh
};

/// Groups the faces of a closed mesh: a patch grows over edges from a face that has none yet, while
/// the centroids of the faces lie within `radius` >= 0 (length) of the first. With radius 0 every
/// face is a patch. Takes time linear in the faces. Throws nothing.
SurfacePatches surface_patches(const IndexedMesh& mesh, double radius);

/// Where curvature is asked for: a point, and a patch at it to start from.
struct BallCentre {
  Vector3 point = Vector3::Zero();
  std::int32_t patch = 0;
};

/// Principal curvatures by a weighted linear fit of normals to positions, over the patches that lie
/// in the ball of `radius` > 0 about a point and hang together with it inside the ball. Weights are
/// area times (1 - d^2 / radius^2)^2, d the distance of a patch's centre. On a sphere and on a
/// cylinder the normal is linear in the position, so their curvature comes out exactly, whatever
/// the radius. Around an edge the turn is conserved: it is spread over the ball. In 1/length,
/// positive where convex; 0 where fewer than three patches lie in the ball.
///
/// The fit of the shape operator to normals follows Rusinkiewicz (2004), "Estimating curvatures and
/// their derivatives on triangle meshes", 3DPVT, 486-493; balls in place of rings make it the same
/// for coarse and fine meshes.
///
/// The same bits on any number of threads. Throws Error(InvalidInput) for a radius that is not
/// positive, Error(Cancelled).
std::vector<PrincipalCurvatures> ball_curvatures(const SurfacePatches& patches,
                                                 const std::vector<BallCentre>& centres,
                                                 double radius, const Execution& execution);

/// For balls of several ascending radii about the same points, in little more time than the largest
/// take: a list of curvatures for each radius.
std::vector<std::vector<PrincipalCurvatures>> ball_curvatures(
    const SurfacePatches& patches, const std::vector<BallCentre>& centres,
    const std::vector<double>& radii, const Execution& execution);

}  // namespace wscvt
