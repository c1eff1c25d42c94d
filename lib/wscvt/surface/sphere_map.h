// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

/// A mesh spread over the unit sphere, one to one.
struct SphereMap {
  std::vector<Vector3> directions;  ///< unit vectors, one for each vertex
  SphereMapReport report;
};

/// Maps a closed mesh of genus 0, as check_mesh returns it, to the sphere: every triangle is
/// counter-clockwise seen from outside by the exact sign of its determinant, and together they
/// cover the sphere once. Whatever the shape of the triangles.
///
/// The mesh is collapsed to a tetrahedron, whose vertices are put on the sphere; the others return
/// one by one, each into the kernel of its ring, and the symmetric Dirichlet energy is lowered from
/// level to level (Praun and Hoppe 2003, "Spherical parametrization and remeshing"; Wan, Ye, Li
/// and Qin 2012, "Efficient spherical parametrization using progressive optimization"; Hu, Fu and
/// Liu 2018, "Advanced hierarchical spherical parameterizations"). The work runs on one thread, so
/// the result is the same on any number.
///
/// Throws Error(InvalidInput) when the mesh is not one closed surface of genus 0,
/// Error(NumericalFailure) when doubles are too coarse for its triangles, and
/// Error(Cancelled).
SphereMap map_to_sphere(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
