// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

/// How far the map is optimised on its way from a tetrahedron to the whole mesh.
struct SphereMapOptions {
  /// Vertices of a level / those of the one before: the map is optimised as a whole once a level.
  double level_growth = 1.5;
  /// Sweeps over all vertices at most, at levels of up to `coarse_vertices` and of up to
  /// `fine_vertices`; there are none above, where they change nothing.
  int coarse_sweeps = 40;
  int fine_sweeps = 10;
  std::size_t coarse_vertices = 4000;
  std::size_t fine_vertices = 30000;
  /// A level is done when four sweeps lower the energy by less than this share.
  double tolerance = 2e-4;
  /// How much keeping angles counts beside keeping areas (see VertexFan): a thin neck or a long
  /// limb becomes rounder on the sphere, and what lies beyond it smaller.
  double angle_weight = 0.0;
};

inline constexpr NumberOption<double> level_growth_option{"level-growth",
                                                          "growth of the map's levels", 1.1, 10.0};
inline constexpr NumberOption<int> coarse_sweeps_option{
    "coarse-sweeps", "number of sweeps on the map's coarse levels", 0, 1000};
inline constexpr NumberOption<int> fine_sweeps_option{
    "fine-sweeps", "number of sweeps on the map's fine levels", 0, 1000};
inline constexpr NumberOption<double> map_tolerance_option{
    "map-tolerance", "tolerance of the map's levels", 0.0, std::numeric_limits<double>::infinity()};
inline constexpr NumberOption<double> angle_weight_option{
    "angle-weight", "weight of the angles in the map's energy", 0.0, 1000.0};

/// A mesh spread over the unit sphere, one to one.
struct SphereMap {
  std::vector<Vector3> directions;  ///< unit vectors, one for each vertex
  SphereMapReport report;
  /// All vertices, from the last survivor of the collapse to the first one collapsed: the first n
  /// of them are a subset well spread over the surface, for every n.
  std::vector<std::int32_t> collapse_order;
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
/// Throws Error(InvalidInput) when the mesh is not one closed surface of genus 0 or an option is
/// out of range, Error(NumericalFailure) when doubles are too coarse for its triangles, and
/// Error(Cancelled).
SphereMap map_to_sphere(const IndexedMesh& mesh, const SphereMapOptions& options,
                        const Execution& execution);

}  // namespace wscvt
