// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/text_writers.h"

#include <charconv>
#include <ostream>

#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

std::string vector_text(const Vector3& v, const std::string& between) {
  return format_exact(v.x()) + between + format_exact(v.y()) + between + format_exact(v.z());
}

void append_exact(std::vector<std::string>& fields, const Vector3& v) {
  for (const double coordinate : v) fields.push_back(format_exact(coordinate));
}

namespace {

/// Returns the corners' indices, counted from `first`.
std::string text_of(const Triangle& t, std::int64_t first, const char* between) {
  return std::to_string(t[0] + first) + between + std::to_string(t[1] + first) + between +
         std::to_string(t[2] + first);
}

std::string lines_of(const std::vector<Vector3>& points) {
  std::string text;
  for (const Vector3& p : points) text += vector_text(p) + "\n";
  return text;
}

std::string lines_of(const std::vector<Triangle>& triangles) {
  std::string text;
  for (const Triangle& t : triangles) text += text_of(t, 0, " ") + "\n";
  return text;
}

/// Returns 3, 6, 9, ...: the end of each triangle's corners.
std::string ends_of(std::size_t triangles) {
  std::string text;
  for (std::size_t f = 1; f <= triangles; ++f) text += std::to_string(3 * f) + "\n";
  return text;
}

std::string vtk_xml(const std::string& type, const std::string& attributes,
                    const std::string& content) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
         "\" version=\"0.1\" byte_order=\"LittleEndian\">\n<" + type + ">\n<Piece " + attributes +
         ">\n" + content + "</Piece>\n</" + type + ">\n</VTKFile>\n";
}

std::string vtk_points(const IndexedMesh& mesh) {
  return "<Points>\n" +
         vtk_data_array("Float64", "Name=\"Points\" NumberOfComponents=\"3\"",
                        lines_of(mesh.points)) +
         "</Points>\n";
}

std::string vtk_corners(const IndexedMesh& mesh) {
  return vtk_data_array("Int64", "Name=\"connectivity\"", lines_of(mesh.triangles)) +
         vtk_data_array("Int64", "Name=\"offsets\"", ends_of(mesh.triangles.size()));
}

/// Returns a number in at most 20 characters.
std::string short_text(double value) {
  constexpr std::size_t longest = 20;
  std::string text = format_exact(value);
  for (int digits = 16; text.size() > longest; --digits) {
    char buffer[40];
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
    text.assign(buffer, end.ptr);
  }
  return text;
}

}  // namespace

void write_stl_text(std::ostream& stream, const IndexedMesh& mesh) {
  stream << "solid grain\n";
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, t);
    const Vector3 across = doubled_area_normal(a, b, c);
    const double length = across.norm();
    const Vector3 normal = length > 0.0 ? Vector3(across / length) : Vector3::Zero();
    stream << "facet normal " << vector_text(normal) << "\nouter loop\n";
    for (const Vector3* p : {&a, &b, &c}) stream << "vertex " << vector_text(*p) << "\n";
    stream << "endloop\nendfacet\n";
  }
  stream << "endsolid grain\n";
}

void write_legacy_vtk(std::ostream& stream, const IndexedMesh& mesh) {
  stream << "# vtk DataFile Version 3.0\ngrain\nASCII\nDATASET POLYDATA\nPOINTS "
         << mesh.points.size() << " double\n"
         << lines_of(mesh.points) << "POLYGONS " << mesh.triangles.size() << " "
         << 4 * mesh.triangles.size() << "\n";
  for (const Triangle& t : mesh.triangles) stream << "3 " << text_of(t, 0, " ") << "\n";
}

std::string vtk_data_array(const std::string& type, const std::string& attributes,
                           const std::string& numbers) {
  return "<DataArray type=\"" + type + "\" " + attributes + " format=\"ascii\">\n" + numbers +
         "</DataArray>\n";
}

void write_vtp(std::ostream& stream, const IndexedMesh& mesh, const std::string& point_data) {
  stream << vtk_xml("PolyData",
                    "NumberOfPoints=\"" + std::to_string(mesh.points.size()) +
                        "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                        "NumberOfPolys=\"" +
                        std::to_string(mesh.triangles.size()) + "\"",
                    point_data + vtk_points(mesh) + "<Polys>\n" + vtk_corners(mesh) + "</Polys>\n");
}

void write_vtu(std::ostream& stream, const IndexedMesh& mesh) {
  std::string types;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) types += "5\n";  // VTK_TRIANGLE
  stream << vtk_xml("UnstructuredGrid",
                    "NumberOfPoints=\"" + std::to_string(mesh.points.size()) +
                        "\" NumberOfCells=\"" + std::to_string(mesh.triangles.size()) + "\"",
                    vtk_points(mesh) + "<Cells>\n" + vtk_corners(mesh) +
                        vtk_data_array("UInt8", "Name=\"types\"", types) + "</Cells>\n");
}

void write_gmsh(std::ostream& stream, const IndexedMesh& mesh) {
  Eigen::AlignedBox3d box = box_of(mesh.points);
  if (mesh.points.empty()) box.extend(Vector3::Zero());
  const std::string nodes = std::to_string(mesh.points.size());
  const std::string faces = std::to_string(mesh.triangles.size());
  // One surface, number 1: its box, no physical groups and no curves.
  stream << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 " << vector_text(box.min())
         << " " << vector_text(box.max()) << " 0 0\n$EndEntities\n$Nodes\n1 " << nodes << " 1 "
         << nodes << "\n2 1 0 " << nodes << "\n";
  for (std::size_t i = 1; i <= mesh.points.size(); ++i) stream << i << "\n";
  stream << lines_of(mesh.points) << "$EndNodes\n$Elements\n1 " << faces << " 1 " << faces
         << "\n2 1 2 " << faces << "\n";
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    stream << f + 1 << " " << text_of(mesh.triangles[f], 1, " ") << "\n";
  }
  stream << "$EndElements\n";
}

double kept_by_abaqus(double coordinate) {
  const std::string text = short_text(coordinate);
  std::from_chars(text.data(), text.data() + text.size(), coordinate);
  return coordinate;
}

void write_abaqus(std::ostream& stream, const IndexedMesh& mesh) {
  stream << "*HEADING\ngrain\n*NODE\n";
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector3& p = mesh.points[i];
    stream << i + 1 << ", " << short_text(p.x()) << ", " << short_text(p.y()) << ", "
           << short_text(p.z()) << "\n";
  }
  stream << "*ELEMENT, TYPE=S3, ELSET=grain\n";
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    stream << f + 1 << ", " << text_of(mesh.triangles[f], 1, ", ") << "\n";
  }
}

}  // namespace wscvt
