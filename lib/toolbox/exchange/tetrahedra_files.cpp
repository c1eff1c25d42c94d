// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/tetrahedra_files.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

/// Returns corners, counted from `first`.
template <class Corners>
std::string corner_text(const Corners& corners, std::int32_t first, const std::string& between) {
  std::string text;
  for (const std::int32_t corner : corners) {
    text += (text.empty() ? "" : between) + std::to_string(corner + first);
  }
  return text;
}

std::string vtu_text(const TetrahedralMesh& mesh) {
  const std::vector<Vector3>& points = mesh.surface.points;
  std::string places;
  std::string corners;
  std::string ends;
  std::string types;
  for (const Vector3& p : points) places += vector_text(p) + "\n";
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k) {
    corners += corner_text(mesh.tetrahedra[k], 0, " ") + "\n";
    ends += std::to_string(4 * (k + 1)) + "\n";
    types += "10\n";  // VTK_TETRA
  }
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
         std::to_string(points.size()) + "\" NumberOfCells=\"" +
         std::to_string(mesh.tetrahedra.size()) + "\">\n<Points>\n" +
         vtk_data_array("Float64", "Name=\"Points\" NumberOfComponents=\"3\"", places) +
         "</Points>\n<Cells>\n" + vtk_data_array("Int64", "Name=\"connectivity\"", corners) +
         vtk_data_array("Int64", "Name=\"offsets\"", ends) +
         vtk_data_array("UInt8", "Name=\"types\"", types) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string gmsh_text(const TetrahedralMesh& mesh) {
  const std::vector<Vector3>& points = mesh.surface.points;
  Vector3 low = points.front();
  Vector3 high = low;
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const std::string box = vector_text(low) + " " + vector_text(high);
  const std::string nodes = std::to_string(points.size());
  const std::size_t triangles = mesh.surface.triangles.size();
  const std::string elements = std::to_string(triangles + mesh.tetrahedra.size());
  // Surface 1 bounds volume 1. All nodes are given with the volume.
  std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"surface\"\n3 2 "
      "\"grain\"\n$EndPhysicalNames\n$Entities\n0 0 1 1\n1 " +
      box + " 1 1 0\n1 " + box + " 1 2 1 1\n$EndEntities\n$Nodes\n1 " + nodes + " 1 " + nodes +
      "\n3 1 0 " + nodes + "\n";
  for (std::size_t i = 1; i <= points.size(); ++i) text += std::to_string(i) + "\n";
  for (const Vector3& p : points) text += vector_text(p) + "\n";
  text += "$EndNodes\n$Elements\n2 " + elements + " 1 " + elements + "\n2 1 2 " +
          std::to_string(triangles) + "\n";
  std::size_t number = 0;
  for (const Triangle& t : mesh.surface.triangles) {
    text += std::to_string(++number) + " " + corner_text(t, 1, " ") + "\n";
  }
  text += "3 1 4 " + std::to_string(mesh.tetrahedra.size()) + "\n";
  for (const Tetrahedron& t : mesh.tetrahedra) {
    text += std::to_string(++number) + " " + corner_text(t, 1, " ") + "\n";
  }
  return text + "$EndElements\n";
}

/// Returns rows of "element, face": the faces of the tetrahedra that are the surface.
std::string surface_rows(const TetrahedralMesh& mesh) {
  // Faces of C3D4: 1-2-3, 1-4-2, 2-4-3, 3-4-1.
  constexpr std::array<std::array<std::size_t, 3>, 4> faces = {
      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  const auto sorted = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  std::map<Triangle, std::string> rows;
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k) {
    const Tetrahedron& t = mesh.tetrahedra[k];
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& [a, b, c] = faces[f];
      rows[sorted({t[a], t[b], t[c]})] =
          std::to_string(k + 1) + ", S" + std::to_string(f + 1) + "\n";
    }
  }
  std::string text;
  for (const Triangle& t : mesh.surface.triangles) text += rows.at(sorted(t));
  return text;
}

std::string abaqus_text(const TetrahedralMesh& mesh) {
  std::string text = "*HEADING\ngrain\n*NODE, NSET=grain_nodes\n";
  for (std::size_t i = 0; i < mesh.surface.points.size(); ++i) {
    text += std::to_string(i + 1);
    for (const double x : mesh.surface.points[i]) text += ", " + format_exact(kept_by_abaqus(x));
    text += "\n";
  }
  text += "*ELEMENT, TYPE=C3D4, ELSET=grain\n";
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k) {
    text += std::to_string(k + 1) + ", " + corner_text(mesh.tetrahedra[k], 1, ", ") + "\n";
  }
  std::int32_t last = 0;
  for (const Triangle& t : mesh.surface.triangles) last = std::max({last, t[0], t[1], t[2]});
  return text + "*NSET, NSET=surface_nodes, GENERATE\n1, " + std::to_string(last + 1) +
         "\n*SURFACE, NAME=surface, TYPE=ELEMENT\n" + surface_rows(mesh);
}

}  // namespace

void check_tetrahedra_file(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".vtu" || ending == ".msh" || ending == ".inp") return;
  refuse("\"" + path +
         "\" is no name for tetrahedra. Give a name that ends in .vtu, .msh or .inp.");
}

void write_tetrahedra(const std::string& path, const TetrahedralMesh& mesh) {
  check_tetrahedra_file(path);
  const std::string ending = ending_of(path);
  write_file(path, ending == ".vtu"   ? vtu_text(mesh)
                   : ending == ".msh" ? gmsh_text(mesh)
                                      : abaqus_text(mesh));
}

}  // namespace wscvt
