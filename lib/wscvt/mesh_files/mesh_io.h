// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Reads a triangle mesh into flat arrays and cuts polygons into fans. The extension, in upper or
/// lower case, gives the format: PLY, STL, OBJ, OFF, VTP, VTU, VTK, MSH, INP, and for points
/// without faces XYZ, CSV and PCD (see their readers for the forms). Each file may be packed by
/// gzip and may then have .gz after its extension. Coordinates keep the precision of the file.
/// Repairs nothing: each triangle of an STL file has three points of its own (see check_mesh). A
/// file without faces gives only points (see mesh_of_points).
///
/// Allocates memory for the data that the file has, never for the counts in its header. Throws
/// Error(InputOutput) with the line of a text or the element of a binary file, if the file cannot
/// be read, is cut short, refers to missing vertices or has only faces of less than three corners.
/// Throws Error(InvalidInput) if the extension is unknown, and Error(Cancelled).
IndexedMesh read_mesh(const std::string& path, const Execution& execution = Execution(1));

/// The content of a mesh file.
struct MeshFile {
  IndexedMesh mesh;
  /// PLY: colour, quality, labels. OBJ: colour. Both: a texture without its pictures, see
  /// read_pictures.
  MeshAttributes attributes;
  std::vector<std::string> material_libraries;  ///< .mtl files that an OBJ names
  /// OBJ: its objects, and its groups. STL as text: its solids. MSH: its physical groups of
  /// surfaces. INP: the sets of its elements. PLY, VTK and VTP: the labels of faces, by their
  /// numbers; VTK and VTP: of both sides of faces too. A list is there only if it has at least two
  /// names, the coarser list first.
  std::vector<NamedFaces> named_faces;
  std::vector<std::string> warnings;  ///< oddities of the file, one sentence each
};

/// Reads the texture's pictures of a mesh that was read from `path`, from the same folder. Adds a
/// warning for each file that is missing or cannot be read; its faces get no colour. Throws
/// Error(Cancelled).
void read_pictures(MeshFile& file, const std::string& path,
                   const Execution& execution = Execution(1));

/// Reads a mesh as read_mesh does, with its attributes. Adds warnings about harmless faults, such
/// as bytes after the end of the file.
MeshFile read_mesh_file(const std::string& path, const Execution& execution = Execution(1));

/// The use of a format; some formats are only read or only written.
enum class MeshUse { Read, Write };

/// Whether the extension of a path is a format for this use.
bool is_mesh_format(const std::string& path, MeshUse use);

/// Throws Error(InvalidInput), with the extensions for this use, if the extension of a path is
/// another.
void check_mesh_format(const std::string& path, MeshUse use);

/// Returns the extensions for a use, as ".ply, .stl or .obj".
std::string mesh_extensions(MeshUse use);

/// Whether a file in a folder counts as a scan, by its extension. Tables, point clouds and
/// finite-element meshes do not count: the user must name them.
bool is_mesh_file(const std::string& path);

/// Number of digits that a binary PLY file keeps of each coordinate.
enum class PlyCoordinates { Double, Float };

/// Returns the mesh with the coordinates that write_mesh keeps in a file with this name. Throws as
/// check_mesh_format.
IndexedMesh as_written(IndexedMesh mesh, const std::string& path,
                       PlyCoordinates coordinates = PlyCoordinates::Double);

/// Writes a mesh in the format of the extension, completely or not at all (see write_file): PLY,
/// STL, OBJ, OFF, VTK (legacy), VTP, VTU, MSH (Gmsh 4.1) and INP (Abaqus). PLY is binary, with
/// double coordinates by default. STL is binary, with that format's float coordinates, or text. The
/// others are text. Only binary STL and INP lose digits, because their numbers are short. Throws
/// Error(InputOutput) if the file cannot be written or different vertices would become equal in the
/// floats of STL; an existing file then stays as it was. Throws Error(InvalidInput) if the
/// extension is unknown or a coordinate is not finite, also in the floats of PLY and STL.
void write_mesh(const IndexedMesh& mesh, const std::string& path,
                PlyCoordinates coordinates = PlyCoordinates::Double);

/// Whether write_mesh keeps attributes in a file with this name. Only PLY does.
bool holds_attributes(const std::string& path);

/// Writes a mesh with the numbers at its vertices and faces; only PLY keeps them. Rounds numbers of
/// an integer type. Throws as the function above, and Error(InvalidInput) if the number of values
/// differs from the number of vertices or faces, or a name cannot be one of PLY.
void write_mesh(const IndexedMesh& mesh, const MeshAttributes& attributes, const std::string& path);

}  // namespace wscvt
