// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/tetrahedra_files.h"

#include <Eigen/Geometry>
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

std::vector<MeshPart> surfaces_of(const TetrahedralMesh& mesh) {
  std::map<std::array<std::int32_t, 2>, std::vector<std::size_t>> by_sides;
  for (std::size_t t = 0; t < mesh.surface.triangles.size(); ++t) {
    by_sides[mesh.names.empty() ? std::array<std::int32_t, 2>{0, -1} : mesh.sides[t]].push_back(t);
  }
  std::vector<MeshPart> parts;
  for (auto& [sides, triangles] : by_sides) {
    std::string name = "surface";
    if (!mesh.names.empty()) {
      name = (sides[1] < 0 ? "surface_" : "wall_") + mesh.names[sides[0]] +
             (sides[1] < 0 ? "" : "_" + mesh.names[sides[1]]);
    }
    parts.push_back({name, std::move(triangles), sides});
  }
  return parts;
}

std::vector<MeshPart> volumes_of(const TetrahedralMesh& mesh) {
  std::vector<MeshPart> parts(std::max<std::size_t>(mesh.names.size(), 1));
  for (std::size_t b = 0; b < parts.size(); ++b) {
    parts[b].name = mesh.kind + (mesh.names.empty() ? "" : "_" + mesh.names[b]);
  }
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k) {
    parts[mesh.names.empty() ? 0 : mesh.bodies[k]].members.push_back(k);
  }
  return parts;
}

/// Returns the body of each tetrahedron as cell data, if the names are numbers.
std::string vtu_bodies(const TetrahedralMesh& mesh) {
  const bool are_numbers =
      std::all_of(mesh.names.begin(), mesh.names.end(), [](const std::string& name) {
        return !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
      });
  if (mesh.names.empty() || !are_numbers) return "";
  std::string values;
  for (const std::int32_t body : mesh.bodies) values += mesh.names[body] + "\n";
  return "<CellData>\n" + vtk_data_array("Int64", "Name=\"" + mesh.kind + "\"", values) +
         "</CellData>\n";
}

std::string vtu_text(const TetrahedralMesh& mesh) {
  std::string corners;
  for (const Tetrahedron& t : mesh.tetrahedra) corners += corner_text(t, 0, " ") + "\n";
  constexpr int vtk_tetra = 10;
  return vtu_of_cells(mesh.surface.points, mesh.tetrahedra.size(), 4, vtk_tetra, corners,
                      vtu_bodies(mesh));
}

/// Returns the surfaces, as rows of "element, face". Of a wall the first body's faces.
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
      rows.emplace(sorted({t[a], t[b], t[c]}),
                   std::to_string(k + 1) + ", S" + std::to_string(f + 1) + "\n");
    }
  }
  std::string text;
  for (const MeshPart& part : surfaces_of(mesh)) {
    text += "*SURFACE, NAME=" + part.name + ", TYPE=ELEMENT\n";
    for (const std::size_t t : part.members) text += rows.at(sorted(mesh.surface.triangles[t]));
  }
  return text;
}

std::string abaqus_text(const TetrahedralMesh& mesh) {
  std::string text = "*HEADING\ngrain\n*NODE, NSET=grain_nodes\n";
  for (std::size_t i = 0; i < mesh.surface.points.size(); ++i) {
    text += std::to_string(i + 1);
    for (const double x : mesh.surface.points[i]) text += ", " + format_exact(kept_by_abaqus(x));
    text += "\n";
  }
  for (const MeshPart& part : volumes_of(mesh)) {
    text += "*ELEMENT, TYPE=C3D4, ELSET=" + part.name + "\n";
    for (const std::size_t k : part.members) {
      text += std::to_string(k + 1) + ", " + corner_text(mesh.tetrahedra[k], 1, ", ") + "\n";
    }
  }
  std::int32_t last = 0;
  for (const Triangle& t : mesh.surface.triangles) last = std::max({last, t[0], t[1], t[2]});
  // The step of 1 is the default, but meshio does not read the line without it.
  return text + "*NSET, NSET=surface_nodes, GENERATE\n1, " + std::to_string(last + 1) + ", 1\n" +
         surface_rows(mesh);
}

}  // namespace

std::string vtu_of_cells(const std::vector<Vector3>& points, std::size_t cells,
                         std::size_t corners_a_cell, int type, const std::string& corners,
                         const std::string& cell_data) {
  std::string places;
  std::string ends;
  std::string types;
  for (const Vector3& p : points) places += vector_text(p) + "\n";
  for (std::size_t k = 1; k <= cells; ++k) {
    ends += std::to_string(corners_a_cell * k) + "\n";
    types += std::to_string(type) + "\n";
  }
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
         std::to_string(points.size()) + "\" NumberOfCells=\"" + std::to_string(cells) + "\">\n" +
         cell_data + "<Points>\n" +
         vtk_data_array("Float64", "Name=\"Points\" NumberOfComponents=\"3\"", places) +
         "</Points>\n<Cells>\n" + vtk_data_array("Int64", "Name=\"connectivity\"", corners) +
         vtk_data_array("Int64", "Name=\"offsets\"", ends) +
         vtk_data_array("UInt8", "Name=\"types\"", types) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string msh_of_parts(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                         const std::vector<MeshPart>& surfaces,
                         const std::vector<Tetrahedron>& tetrahedra,
                         const std::vector<MeshPart>& volumes) {
  const bool is_filled = !tetrahedra.empty();
  Eigen::AlignedBox3d bounding;
  for (const Vector3& p : points) bounding.extend(p);
  const std::string box = vector_text(bounding.min()) + " " + vector_text(bounding.max());
  const std::string nodes = std::to_string(points.size());
  const std::string all = std::to_string(triangles.size() + tetrahedra.size());
  std::string names;
  std::string entities;
  std::string elements;
  std::size_t number = 0;
  const auto add_elements = [&](const MeshPart& part, const std::string& entity,
                                const auto& corners) {
    elements += entity + " " + std::to_string(part.members.size()) + "\n";
    for (const std::size_t k : part.members) {
      elements += std::to_string(++number) + " " + corner_text(corners[k], 1, " ") + "\n";
    }
  };
  std::vector<std::string> bounds(volumes.size());
  std::vector<std::size_t> bound_counts(volumes.size(), 0);
  std::size_t tag = 0;
  for (const MeshPart& part : surfaces) {
    const std::string own = std::to_string(++tag);
    names += "2 " + own + " \"" + part.name + "\"\n";
    entities += own + " " + box + " 1 " + own + " 0\n";
    for (std::size_t side = 0; side < 2; ++side) {
      if (part.sides[side] < 0) continue;
      bounds[part.sides[side]] += (side == 0 ? " " : " -") + own;
      ++bound_counts[part.sides[side]];
    }
    add_elements(part, "2 " + own + " 2", triangles);
  }
  for (std::size_t b = 0; b < volumes.size(); ++b) {
    const std::string own = std::to_string(b + 1);
    // With elements of their own, volumes have the numbers of groups after the surfaces'.
    const std::string group = is_filled ? std::to_string(++tag) : own;
    names += "3 " + group + " \"" + volumes[b].name + "\"\n";
    entities +=
        own + " " + box + " 1 " + group + " " + std::to_string(bound_counts[b]) + bounds[b] + "\n";
    if (is_filled) add_elements(volumes[b], "3 " + own + " 4", tetrahedra);
  }
  // All nodes are given with the first surface or volume.
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n" +
                     std::to_string(surfaces.size() + volumes.size()) + "\n" + names +
                     "$EndPhysicalNames\n$Entities\n0 0 " + std::to_string(surfaces.size()) + " " +
                     std::to_string(volumes.size()) + "\n" + entities + "$EndEntities\n$Nodes\n1 " +
                     nodes + " 1 " + nodes + "\n" + (is_filled ? "3" : "2") + " 1 0 " + nodes +
                     "\n";
  for (std::size_t i = 1; i <= points.size(); ++i) text += std::to_string(i) + "\n";
  for (const Vector3& p : points) text += vector_text(p) + "\n";
  return text + "$EndNodes\n$Elements\n" + std::to_string(tag) + " " + all + " 1 " + all + "\n" +
         elements + "$EndElements\n";
}

void check_tetrahedra_file(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".vtu" || ending == ".msh" || ending == ".inp") return;
  refuse("\"" + path +
         "\" is no name for tetrahedra. Give a name that ends in .vtu, .msh or .inp.");
}

void write_tetrahedra(const std::string& path, const TetrahedralMesh& mesh) {
  check_tetrahedra_file(path);
  const std::string ending = ending_of(path);
  write_file(path, ending == ".vtu" ? vtu_text(mesh)
                   : ending == ".msh"
                       ? msh_of_parts(mesh.surface.points, mesh.surface.triangles,
                                      surfaces_of(mesh), mesh.tetrahedra, volumes_of(mesh))
                       : abaqus_text(mesh));
}

ReportAddition tetrahedra_addition(const TetrahedralMesh& mesh) {
  return {"Tetrahedra",
          {tetrahedra_line(mesh)},
          "tetrahedra",
          {{"count", mesh.tetrahedra.size()}, {"points", mesh.surface.points.size()}},
          {{"smallest_dihedral_degrees", mesh.smallest_dihedral},
           {"largest_dihedral_degrees", mesh.largest_dihedral},
           {"mean_edge", mesh.mean_edge}}};
}

}  // namespace wscvt
