// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

// One reader for each form of file. `read_mesh` chooses by the ending.

/// Reads a PLY file: text or binary in either byte order, coordinates and indices of any scalar
/// type, faces and triangle strips. Skips other elements and properties. A file without faces gives
/// only points. Throws as read_mesh.
///
/// CGAL, which writes other formats here, is not used for reading. It reads through a null pointer
/// if coordinates are integers or a property precedes the first element, trusts the counts of
/// lists, and takes eleven times as long.
IndexedMesh read_ply(ByteReader& reader);

/// Reads a PLY file as read_ply, with the numbers at its vertices and faces: every property that is
/// not a list, coordinate, normal, texture coordinate or flag. Triangles of a polygon get the
/// polygon's numbers. Triangle strips get no numbers.
///
/// If the header names pictures (comment TextureFile), also reads the texture coordinates: of the
/// faces' corners (lists texcoord with texnumber, as MeshLab writes), or of the vertices (s and t,
/// u and v, texture_u and texture_v).
IndexedMesh read_ply_attributes(ByteReader& reader, MeshAttributes& attributes);

/// Reads an STL file, binary or text, in upper or lower case. A binary file may begin with "solid".
/// Warns about extra bytes at its end, fewer than a triangle takes. Each triangle has three points
/// of its own. Throws as read_mesh; a file without triangles is an error.
///
/// CGAL, which writes STL here, is not used for reading: it reads a text that breaks off as an
/// empty file, and does not read capital letters.
IndexedMesh read_stl(ByteReader& reader);

/// Reads an STL file as read_stl, and appends the names of the solids of a text.
IndexedMesh read_stl_solids(ByteReader& reader, std::vector<NamedFaces>& names);

/// Reads the vertices and faces of an OBJ file: polygons, indices with texture and normal, counted
/// from the end when negative, lines continued by a backslash. Skips lines, groups, materials and
/// the like. A file without faces gives only points. Throws as read_mesh.
///
/// CGAL, which writes OBJ here, is not used for reading: it stops silently at the first unknown
/// line and so returns a part of the scan.
IndexedMesh read_obj(ByteReader& reader);

/// Reads an OBJ file as read_obj. Also reads red, green and blue of its vertices, if
/// three numbers from 0 to 1 follow each vertex's coordinates; its texture, if faces have texture
/// coordinates (vt) and the file names a material library; the names of the libraries; and the
/// names of its objects (o) and groups (g).
IndexedMesh read_obj_attributes(ByteReader& reader, MeshAttributes& attributes,
                                std::vector<std::string>& libraries,
                                std::vector<NamedFaces>& names);

/// Reads an OFF file in text form. Skips normals, colours and texture coordinates (NOFF, COFF,
/// STOFF) and the colours of faces. A file without faces gives only points. Throws as read_mesh.
/// Refuses the binary form and coordinates that are not three-dimensional.
///
/// CGAL, which writes OFF here, is not used for reading: it allocates memory for as many corners as
/// a face claims, 4 GB for a file of fifty bytes.
IndexedMesh read_off(ByteReader& reader);

/// Reads the polygons and strips of VTK's XML PolyData, all pieces: ascii, base64 or appended,
/// plain or by ZLib. Skips vertices, lines and the data of points and faces. A file without faces
/// gives only points. Throws as read_mesh.
IndexedMesh read_vtp(ByteReader& reader);

/// Reads a file as read_vtp, and appends the labels of its faces: data of one whole number for
/// each.
IndexedMesh read_vtp_labels(ByteReader& reader, std::vector<NamedFaces>& names);

/// Reads a mesh from a legacy VTK file (not XML), text or binary, of any version: polygonal data,
/// or an unstructured grid of triangles, quads, polygons and strips. Skips vertices, lines and the
/// data of points and faces. A file without faces gives only points. Throws as read_mesh, also for
/// grids of volumes.
IndexedMesh read_legacy_vtk(ByteReader& reader);

/// Reads a file as read_legacy_vtk, and appends the labels of its faces, if it holds polygons: data
/// of one whole number for each.
IndexedMesh read_legacy_vtk_labels(ByteReader& reader, std::vector<NamedFaces>& names);

// Readers of finite-element meshes, as write_mesh writes them and as others do. They take triangles
// and quadrilaterals, also of second order, by their corners. Other elements are left out, so the
// surface of a volume mesh must be in the file. Throw as read_mesh.

/// Reads a text file of Gmsh, version 2 or 4.1.
IndexedMesh read_gmsh(ByteReader& reader);

/// Reads nodes and shell elements of an Abaqus input file. Parts and instances are not moved.
IndexedMesh read_abaqus(ByteReader& reader);

/// Reads the points of a file of the Point Cloud Library: text, binary or packed. Skips all fields
/// except x, y and z. Leaves out points without a finite position, with a warning; clouds in rows
/// have such points where nothing was seen. Throws as read_mesh.
IndexedMesh read_pcd(ByteReader& reader);

/// Reads points from a text, one per line: x, y, z and ignored columns, separated by blanks, tabs,
/// commas or semicolons. Skips empty lines and lines that begin with #. The first line may name the
/// columns. Columns x, y and z (or Points:0 to Points:2, as ParaView names them) are then read, in
/// any position and case. Throws as read_mesh.
IndexedMesh read_point_text(ByteReader& reader);

}  // namespace wscvt
