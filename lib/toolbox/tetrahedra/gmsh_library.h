// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace wscvt {

/// What Gmsh makes of a surface: numbers from 0.
struct GmshVolume {
  std::vector<double> coordinates;   ///< three per point
  std::vector<std::size_t> corners;  ///< four per tetrahedron
};

/// Throws Error(InvalidInput) that says what to install, if Gmsh's library cannot be opened.
void require_gmsh();

/// Fills a surface with tetrahedra. `coordinates`: three per point, of the order of 1. `corners`:
/// three per triangle. `edge`: largest wanted. The points keep their numbers. One thread works at a
/// time, the others wait. Throws Error as require_gmsh, and NumericalFailure with Gmsh's words.
GmshVolume gmsh_volume(std::vector<double> coordinates, std::vector<std::size_t> corners,
                       double edge);

}  // namespace wscvt
