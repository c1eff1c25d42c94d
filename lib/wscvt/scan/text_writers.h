// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

// Meshes as text for other programs. Coordinates are written with the digits that read back to the
// same double, unless told otherwise.

/// STL as text, of one solid; the normals are the triangles' own.
void write_stl_text(std::ostream& stream, const IndexedMesh& mesh);

/// VTK's files from before XML: polygonal data.
void write_legacy_vtk(std::ostream& stream, const IndexedMesh& mesh);

/// VTK's XML: polygonal data. `point_data`: elements of what the points carry, or nothing.
void write_vtp(std::ostream& stream, const IndexedMesh& mesh, const std::string& point_data = "");

/// VTK's XML: an unstructured grid of triangles.
void write_vtu(std::ostream& stream, const IndexedMesh& mesh);

/// An element of VTK's XML: `attributes` without type and format, `numbers` as text.
std::string vtk_data_array(const std::string& type, const std::string& attributes,
                           const std::string& numbers);

/// Gmsh's format 4.1, as text: one discrete surface, of triangles.
void write_gmsh(std::ostream& stream, const IndexedMesh& mesh);

/// An input of Abaqus: the nodes, and the triangles as elements S3 in the set "grain". Its numbers
/// have at most 20 characters, of which a coordinate keeps 12 digits or more.
void write_abaqus(std::ostream& stream, const IndexedMesh& mesh);

/// What write_abaqus keeps of a coordinate.
double kept_by_abaqus(double coordinate);

}  // namespace wscvt
