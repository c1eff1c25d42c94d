// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

struct MeshFile;

// One reader for each form of file. `read_mesh_file` chooses by the ending. Each fills the mesh,
// and what the file has besides it. A file without faces gives only points, unless stated
// otherwise. All throw as read_mesh_file.

/// Reads a PLY file: text or binary in either byte order, coordinates and indices of any scalar
/// type, faces and triangle strips, and the numbers at its vertices and faces: every property that
/// is not a list, coordinate, normal, texture coordinate or flag. Triangles of a polygon get the
/// polygon's numbers. Triangle strips get no numbers. Skips other elements.
///
/// If the header names pictures (comment TextureFile), also reads the texture coordinates: of the
/// faces' corners (lists texcoord with texnumber, as MeshLab writes), or of the vertices (s and t,
/// u and v, texture_u and texture_v).
///
/// CGAL, which writes other formats here, is not used for reading. It reads through a null pointer
/// if coordinates are integers or a property precedes the first element, and trusts the counts of
/// lists.
void read_ply(ByteReader& reader, MeshFile& file);

/// Reads an STL file, binary or text, in upper or lower case, and the names of the solids of a
/// text. A binary file may begin with "solid". Warns about extra bytes at its end, fewer than a
/// triangle takes. Each triangle has three points of its own. A file without triangles is an error.
///
/// CGAL, which writes STL here, is not used for reading: it reads a text that breaks off as an
/// empty file, and does not read capital letters.
void read_stl(ByteReader& reader, MeshFile& file);

/// Reads the vertices and faces of an OBJ file: polygons, indices with texture and normal, counted
/// from the end when negative, lines continued by a backslash. Also reads red, green and blue of
/// its vertices, if three numbers from 0 to 1 follow each vertex's coordinates; its texture, if
/// faces have texture coordinates (vt) and the file names a material library; the names of the
/// libraries; and the names of its objects (o) and groups (g). Skips other lines.
///
/// CGAL, which writes OBJ here, is not used for reading: it stops silently at the first unknown
/// line and so returns a part of the scan.
void read_obj(ByteReader& reader, MeshFile& file);

/// Reads an OFF file in text form. Skips normals, colours and texture coordinates (NOFF, COFF,
/// STOFF) and the colours of faces. Refuses the binary form and coordinates that are not
/// three-dimensional.
///
/// CGAL, which writes OFF here, is not used for reading: it allocates memory for as many corners as
/// a face claims, 4 GB for a file of fifty bytes.
void read_off(ByteReader& reader, MeshFile& file);

/// Reads the polygons and strips of VTK's XML PolyData, all pieces: ascii, base64 or appended,
/// plain or by ZLib; and the labels of its faces: data of one whole number for each. Skips
/// vertices, lines and other data.
void read_vtp(ByteReader& reader, MeshFile& file);

/// Reads a mesh from a legacy VTK file (not XML), text or binary, of any version: polygonal data,
/// or an unstructured grid, of which it takes the surface cells. Reads the labels as read_vtp().
/// Skips vertices, lines, bodies and other data.
void read_legacy_vtk(ByteReader& reader, MeshFile& file);

// Readers of finite-element meshes, as write_mesh writes them and as others do. They take triangles
// and quadrilaterals, also of second order, by their corners. Other elements are left out, so the
// surface of a volume mesh must be in the file.

/// Reads a text file of Gmsh, version 2 or 4.1.
void read_gmsh(ByteReader& reader, MeshFile& file);

/// Reads nodes and shell elements of an Abaqus input file. Parts and instances are not moved.
void read_abaqus(ByteReader& reader, MeshFile& file);

/// Reads the points of a file of the Point Cloud Library: text, binary or packed. Skips all fields
/// except x, y and z. Leaves out points without a finite position, with a warning; clouds in rows
/// have such points where nothing was seen.
void read_pcd(ByteReader& reader, MeshFile& file);

/// Reads points from a text, one per line: x, y, z and ignored columns, separated by blanks, tabs,
/// commas or semicolons. Skips empty lines and lines that begin with #. The first line may name the
/// columns. Columns x, y and z (or Points:0 to Points:2, as ParaView names them) are then read, in
/// any position and case.
void read_point_text(ByteReader& reader, MeshFile& file);

/// Reads the pictures with these names from the folder of the mesh, `mesh_path`. With `libraries`,
/// files of materials (.mtl), the names are names of materials. A material without a picture
/// becomes one pixel of its colour, if another material has a picture. Also looks for a name
/// without its folders, because it may come from another machine. Adds a warning for each file that
/// is missing or cannot be read. Throws Error(Cancelled).
std::vector<TexturePicture> pictures_of(const std::vector<std::string>& names,
                                        const std::vector<std::string>& libraries,
                                        const std::string& mesh_path,
                                        std::vector<std::string>& warnings,
                                        const Execution& execution);

/// Reads a picture: PNG, JPEG, BMP or TGA. Grey values become colours; transparency is ignored.
/// Throws Error(InputOutput) for a file that cannot be read or has more than 400 million pixels,
/// and if wscvt was built without stb_image.
TexturePicture read_picture(const std::string& path);

}  // namespace wscvt
