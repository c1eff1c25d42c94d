// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

/// Four points by their numbers. The first three are counter-clockwise seen from the fourth.
using Tetrahedron = std::array<std::int32_t, 4>;

/// A body of tetrahedra, or several with common walls.
struct TetrahedralMesh {
  /// Points and triangles of the surface, and inner points behind the surface's.
  IndexedMesh surface;
  std::vector<Tetrahedron> tetrahedra;
  double smallest_dihedral = 180.0;  ///< angle between two faces of a tetrahedron, degrees
  double largest_dihedral = 0.0;     ///< degrees
  double mean_edge = 0.0;            ///< over the edges of all tetrahedra, length
  std::string kind = "grain";        ///< what a body is, for names
  std::vector<std::string> names;    ///< of several bodies, such as labels; empty: a single one
  std::vector<std::int32_t> bodies;  ///< of several: of each tetrahedron, ascending
  /// Of several bodies: those inside and outside of each triangle; -1 outside: none.
  std::vector<std::array<std::int32_t, 2>> sides;
  std::vector<double> body_dihedrals;  ///< of several: the smallest angle in each, degrees
};

inline constexpr NumberOption<double> tetrahedra_edge_option = {
    "edge-length", "longest wanted edge of tetrahedra",
    0.0,           std::numeric_limits<double>::infinity(),
    Ends::Both,    "inside the remesh, in the unit of the output. 0: as the remesh's edges"};

/// More are refused, because Gmsh cannot be stopped and needs minutes and gigabytes for them.
inline constexpr double most_tetrahedra = 5e6;

/// With smaller dihedral angles, tetrahedra make equations hard to solve.
inline constexpr double least_dihedral = 12.0;  // degrees

/// Throws Error(InvalidInput) that says what to install, if Gmsh is not there.
void require_tetrahedra();

/// Fills a closed outward mesh with tetrahedra, by Gmsh. The surface keeps its points and
/// triangles to the bit, and inner points are added. `edge`: the longest wanted edge inside,
/// length; 0: as on the surface. It is reached gradually from the surface's edges. If an angle is
/// below least_dihedral, up to three fills with shorter edges (.9, .8 and .7 of `edge` or of the
/// surface's mean edge, the smaller) are tried, and the best one is taken. The same input gives the
/// same result.
///
/// Gmsh (Geuzaine and Remacle 2009, Int. J. Numer. Meth. Eng. 79, 1309-1331) is opened only here,
/// because its libraries cost .09 s and 50 MB. It keeps a state of its own, so one thread works at
/// a time. Throws Error: InvalidInput as require_tetrahedra, for an edge below 0, for one that
/// needs more than most_tetrahedra, and for a mesh without volume; NumericalFailure if Gmsh cannot
/// fill the mesh, as when it intersects itself; Cancelled before the work.
TetrahedralMesh tetrahedra_in(const IndexedMesh& surface, double edge,
                              const Execution& execution = Execution());

/// Fills several bodies, each by itself. Where two have triangles of the same points, to the bit,
/// they share them. `kind` and `names` are for files and messages. Throws Error as above, with the
/// name of the body, and InvalidInput without a body.
TetrahedralMesh tetrahedra_in(const std::vector<IndexedMesh>& bodies, const std::string& kind,
                              const std::vector<std::string>& names, double edge,
                              const Execution& execution = Execution());

/// Returns a line for a log: numbers and angles, and of several bodies the one with the smallest
/// angle and how many have one below `least_dihedral`.
std::string tetrahedra_line(const TetrahedralMesh& mesh);

}  // namespace wscvt
