// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

/// A one-to-one map of a mesh to the unit sphere.
struct SphereMap {
  std::vector<Vector3> directions;  ///< unit vectors, one for each vertex
  SphereMapReport report;
};

/// Maps a closed mesh of genus 0, as check_mesh returns it, to the sphere. Every triangle is
/// counter-clockwise seen from outside, by the exact sign of its determinant, and the triangles
/// cover the sphere once. Triangles may have any shape.
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
SphereMap map_to_sphere(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
