// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

// Writes meshes as text for other programs. Coordinates have the digits that read back to the same
// double, unless stated otherwise.

/// Returns "x y z", with the digits that read back to the same doubles.
std::string vector_text(const Vector3& v, const std::string& between = " ");

/// Appends x, y and z with the same digits.
void append_exact(std::vector<std::string>& fields, const Vector3& v);

/// Writes STL as text: one solid, with the triangles' normals.
void write_stl_text(std::ostream& stream, const IndexedMesh& mesh);

/// Writes a legacy VTK file (not XML): polygonal data.
void write_legacy_vtk(std::ostream& stream, const IndexedMesh& mesh);

/// Writes VTK's XML: polygonal data. `point_data`: XML elements of the data at the points, or
/// empty.
void write_vtp(std::ostream& stream, const IndexedMesh& mesh, const std::string& point_data = "");

/// Writes VTK's XML: an unstructured grid of triangles.
void write_vtu(std::ostream& stream, const IndexedMesh& mesh);

/// Returns an element of VTK's XML: `attributes` without type and format, `numbers` as text.
std::string vtk_data_array(const std::string& type, const std::string& attributes,
                           const std::string& numbers);

/// Writes Gmsh's format 4.1 as text: one discrete surface of triangles.
void write_gmsh(std::ostream& stream, const IndexedMesh& mesh);

/// Writes an Abaqus input file: the nodes, and the triangles as elements S3 in the set "grain".
/// Numbers have at most 20 characters, so a coordinate keeps 12 digits or more.
void write_abaqus(std::ostream& stream, const IndexedMesh& mesh);

/// Returns a coordinate as write_abaqus keeps it.
double kept_by_abaqus(double coordinate);

}  // namespace wscvt
