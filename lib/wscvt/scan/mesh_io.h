// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Reads a triangle mesh into flat arrays; polygons are cut into fans. The format follows from the
/// extension, in either case: PLY, STL, OBJ, OFF, VTP, VTK and, of points alone, XYZ, CSV and PCD
/// (see their readers for the forms). Each may be packed by gzip, and may then end in .gz behind
/// the extension. Coordinates keep the precision of the file. Nothing is repaired: an STL file
/// comes back with the corners of each triangle as points of their own (see check_mesh). A file
/// that holds no faces at all gives points alone (see mesh_of_points).
///
/// Takes memory for what is there, never for what a file claims. Throws Error(InputOutput), which
/// names the line of a text or the element of a binary file, when the file cannot be read, is cut
/// short, names vertices it does not hold or has only faces of less than three corners;
/// Error(InvalidInput) when the extension is not known, and Error(Cancelled).
IndexedMesh read_mesh(const std::string& path, const Execution& execution = Execution(1));

/// A mesh as its file holds it.
struct MeshFile {
  IndexedMesh mesh;
  /// Of PLY: colour, quality, labels. Of OBJ: colour. Of both a texture without its pictures, see
  /// read_pictures.
  MeshAttributes attributes;
  std::vector<std::string> material_libraries;  ///< that an OBJ names (.mtl)
  std::vector<std::string> warnings;            ///< of what is odd about the file, a sentence each
};

/// Reads the pictures of the texture of a mesh that was read from `path`, from the mesh's folder.
/// Adds a warning for each file that is missing or cannot be read: its faces are left without
/// colour. Throws Error(Cancelled).
void read_pictures(MeshFile& file, const std::string& path,
                   const Execution& execution = Execution(1));

/// A mesh with remarks on its file that do no harm, such as bytes behind its end.
MeshFile read_mesh_file(const std::string& path, const Execution& execution = Execution(1));

/// Formats are read, written, or both.
enum class MeshUse { Read, Write };

/// Whether the extension of a path is that of a format of that use.
bool is_mesh_format(const std::string& path, MeshUse use);

/// Throws Error(InvalidInput), with the extensions of that use, when the extension of a path is of
/// none.
void check_mesh_format(const std::string& path, MeshUse use);

/// ".ply, .stl or .obj": the extensions of a use.
std::string mesh_extensions(MeshUse use);

/// Whether a file in a folder of scans is one of them, by its extension. Tables and clouds of
/// points are not: they have to be named.
bool is_mesh_file(const std::string& path);

/// Number of digits that a binary PLY file keeps of each coordinate.
enum class PlyCoordinates { Double, Float };

/// The mesh with the coordinates that write_mesh keeps in a file of that name. Throws as
/// check_mesh_format.
IndexedMesh as_written(IndexedMesh mesh, const std::string& path,
                       PlyCoordinates coordinates = PlyCoordinates::Double);

/// Writes a mesh in the format of the extension, whole or not at all (see write_file): PLY, STL,
/// OBJ, OFF, VTK (legacy), VTP, VTU, MSH (Gmsh 4.1) and INP (Abaqus). PLY is binary, with double
/// coordinates unless told otherwise, STL binary with the float coordinates of that format, or
/// text; the others are text. All but binary STL and INP, whose numbers are short, lose nothing.
/// Throws Error(InputOutput) when the file cannot be written or different vertices would fall
/// together in the floats of STL, and leaves an existing file as it was; Error(InvalidInput) when
/// the extension is not known.
void write_mesh(const IndexedMesh& mesh, const std::string& path,
                PlyCoordinates coordinates = PlyCoordinates::Double);

/// Whether write_mesh keeps attributes in a file of that name: PLY does.
bool holds_attributes(const std::string& path);

/// Writes a mesh with the numbers at its vertices and faces, which only PLY keeps. Numbers of a
/// whole type are rounded. Throws as the function above, and Error(InvalidInput) for another number
/// of values than of vertices or faces.
void write_mesh(const IndexedMesh& mesh, const MeshAttributes& attributes, const std::string& path);

}  // namespace wscvt
