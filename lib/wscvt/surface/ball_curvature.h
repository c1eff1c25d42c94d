// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// A small connected part of a mesh. These three values represent its faces in ball_curvatures.
struct SurfacePatch {
  Vector3 centre = Vector3::Zero();  ///< centroid; length
  /// Vector area / area: the mean unit normal, shorter than 1 if the patch bends. Zero for a patch
  /// without area.
  Vector3 normal = Vector3::Zero();
  double area = 0.0;  ///< length^2
};

/// The faces of a mesh, grouped into patches.
struct SurfacePatches {
  std::vector<SurfacePatch> patches;
  Groups neighbours;                   ///< of each patch, across edges; each once
  std::vector<std::int32_t> of_faces;  ///< the patch of each face of the mesh
};

/// Groups the faces of a closed mesh into patches. A patch starts at the face without a patch that
/// is farthest from the middle of the mesh, so the order of the faces does not matter, and grows
/// over edges, while the faces' centroids are within `radius` >= 0 (length) of the first. With
/// radius 0 every face is a patch. Sorts the faces once. Throws nothing.
SurfacePatches surface_patches(const IndexedMesh& mesh, double radius);

/// The centre of a ball: a point, and a patch at it where the search starts.
struct BallCentre {
  Vector3 point = Vector3::Zero();
  std::int32_t patch = 0;
};

/// Computes principal curvatures by a weighted linear fit of normals to positions, over the patches
/// in the ball of a radius about a point that are connected to it inside the ball. Weights are area
/// times (1 - d^2 / radius^2)^2, d the distance of a patch's centre. On spheres and cylinders the
/// normal is linear in the position, so their curvature is exact for every radius. Around an edge
/// the total turn is conserved and spread over the ball. In 1/length, positive where convex; 0 if
/// the ball contains fewer than three patches.
///
/// The fit of the shape operator to normals follows Rusinkiewicz (2004), "Estimating curvatures and
/// their derivatives on triangle meshes", 3DPVT, 486-493; balls instead of rings make the result
/// independent of the mesh's fineness.
///
/// `radii` > 0 ascend. Returns a list for each, in little more time than the largest takes. The
/// bits do not depend on the number of threads. Throws Error(InvalidInput) if a radius is not
/// positive, and Error(Cancelled).
std::vector<std::vector<PrincipalCurvatures>> ball_curvatures(
    const SurfacePatches& patches, const std::vector<BallCentre>& centres,
    const std::vector<double>& radii, const Execution& execution);

}  // namespace wscvt
