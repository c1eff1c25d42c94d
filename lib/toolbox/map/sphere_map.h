// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Report of a map to the sphere. Distortions are of the triangles with an area above zero.
struct SphereMapReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  int levels = 0;
  int sweeps = 0;                   ///< over all levels
  std::size_t clipped_kernels = 0;  ///< vertices moved to the centroid of their ring's kernel
  std::size_t mended_kernels = 0;   ///< vertices whose ring had to be widened first
  /// (s1 / s2 + s2 / s1) / 2 of the stretches s1, s2 of a triangle; 1: angles are kept. The mean is
  /// over the area.
  double mean_angle_distortion = 1.0;
  double largest_angle_distortion = 1.0;
  /// (Area on the sphere / 4 pi) / (area on the surface / its total): 1: areas are kept.
  double smallest_area_ratio = 1.0;
  double largest_area_ratio = 1.0;
  /// Symmetric Dirichlet energy / energy of an isometry, mean over the area; >= 1.
  double energy = 1.0;
};

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
