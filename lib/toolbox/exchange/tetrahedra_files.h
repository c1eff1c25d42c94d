// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toolbox/tetrahedra/tetrahedra.h"

namespace wscvt {

/// Throws Error(InvalidInput) for a name that does not end in .vtu, .msh or .inp.
void check_tetrahedra_file(const std::string& path);

/// Writes tetrahedra in the format of the ending, completely or not at all (see write_file):
/// - .vtu: VTK's XML, an unstructured grid of tetrahedra;
/// - .msh: Gmsh 4.1, the physical surface "surface" and the physical volume "grain";
/// - .inp: Abaqus and CalculiX, elements C3D4 in the set "grain", the surface "surface" of their
///   faces, and the set of its nodes, "surface_nodes".
/// Of several bodies .vtu has the body's name as cell data, if it is a whole number. The others
/// have a volume or set "grain_A" for each, the surface "surface_A" against the outside, and
/// "wall_A_B" between two; .inp has the faces of A's elements.
/// Numbers of .vtu and .msh read back to the same bits, those of .inp have at most 20 characters.
/// Throws Error as check_tetrahedra_file and write_file.
void write_tetrahedra(const std::string& path, const TetrahedralMesh& mesh);

}  // namespace wscvt
