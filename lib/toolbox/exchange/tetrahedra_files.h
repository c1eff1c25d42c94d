// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "toolbox/tetrahedra/tetrahedra.h"
#include "wscvt/report/report_addition.h"

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

/// A named group of triangles or tetrahedra.
struct MeshPart {
  std::string name;
  std::vector<std::size_t> members;
  std::array<std::int32_t, 2> sides = {0, -1};  ///< of a surface: volumes in and out; -1: none
};

/// Returns VTK's XML: an unstructured grid of cells of one type with a row of corners each.
std::string vtu_of_cells(const std::vector<Vector3>& points, std::size_t cells,
                         std::size_t corners_a_cell, int type, const std::string& corners,
                         const std::string& cell_data);

/// Returns Gmsh 4.1: a physical surface or volume per part, the volumes bounded by the surfaces.
/// Volumes may have no tetrahedra.
std::string msh_of_parts(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                         const std::vector<MeshPart>& surfaces,
                         const std::vector<Tetrahedron>& tetrahedra,
                         const std::vector<MeshPart>& volumes);

/// Returns the part "tetrahedra" of a remesh's report: their number and points, smallest and
/// largest dihedral angle, mean edge.
ReportAddition tetrahedra_addition(const TetrahedralMesh& mesh);

}  // namespace wscvt
