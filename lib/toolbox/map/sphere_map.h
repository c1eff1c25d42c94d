// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Finds a point of the ring's kernel: a position on the sphere for a vertex with neighbours at
/// `ring` (unit vectors, counter-clockwise) such that all its triangles are counter-clockwise by
/// exact predicates. `distances` are the distances to the neighbours on the surface.
///
/// The edges from ring[apex] to the others must triangulate the ring counter-clockwise, as after a
/// collapse. Then the kernel contains points close to ring[apex]. Tries first the mean of the ring,
/// weighted by inverse distance, then the centroid of the kernel clipped from the gnomonic plane
/// about ring[apex], then points ever closer to ring[apex]. Returns nothing if the kernel is too
/// thin for doubles.
std::optional<Vector3> insert_into_kernel(const std::vector<Vector3>& ring,
                                          const std::vector<double>& distances, std::size_t apex);

/// Maps a closed mesh of genus 0, as check_mesh returns it, to the sphere. Returns a unit vector
/// for each vertex. Every triangle is counter-clockwise seen from outside, by the exact sign of its
/// determinant, and the triangles cover the sphere once. Triangles may have any shape.
///
/// The mesh is collapsed to a tetrahedron, and its vertices are put on the sphere. The other
/// vertices return one by one, each into the kernel of its ring. Each level lowers the symmetric
/// Dirichlet energy (Praun and Hoppe 2003, "Spherical parametrization and remeshing"; Wan, Ye, Li
/// and Qin 2012, "Efficient spherical parametrization using progressive optimization"; Hu, Fu and
/// Liu 2018, "Advanced hierarchical spherical parameterizations"). Runs on one thread, so the
/// result does not depend on the number of threads.
///
/// Throws Error(InvalidInput) if the mesh is not one closed surface of genus 0,
/// Error(NumericalFailure) if doubles are too coarse for its triangles, and Error(Cancelled).
std::vector<Vector3> map_to_sphere(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
