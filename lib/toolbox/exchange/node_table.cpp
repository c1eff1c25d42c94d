// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/node_table.h"

#include <sstream>
#include <utility>

#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

std::string lines_of(const std::vector<Vector3>& vectors) {
  std::string text;
  for (const Vector3& v : vectors) text += vector_text(v) + "\n";
  return text;
}

}  // namespace

NodeTable node_table(IndexedMesh mesh) {
  NodeTable nodes;
  nodes.normals = vertex_normals(mesh.points, mesh.triangles);
  nodes.areas = vertex_areas(mesh);
  nodes.mesh = std::move(mesh);
  return nodes;
}

std::string nodes_csv(const NodeTable& nodes) {
  std::string text = csv_record({"x", "y", "z", "nx", "ny", "nz", "area"});
  for (std::size_t i = 0; i < nodes.mesh.points.size(); ++i) {
    const Vector3& p = nodes.mesh.points[i];
    const Vector3& n = nodes.normals[i];
    text += csv_record({format_exact(p.x()), format_exact(p.y()), format_exact(p.z()),
                        format_exact(n.x()), format_exact(n.y()), format_exact(n.z()),
                        format_exact(nodes.areas[i])});
  }
  return text;
}

std::string nodes_vtp(const NodeTable& nodes) {
  std::string areas;
  for (const double area : nodes.areas) areas += format_exact(area) + "\n";
  std::ostringstream text;
  write_vtp(text, nodes.mesh,
            "<PointData Normals=\"normal\" Scalars=\"area\">\n" +
                vtk_data_array("Float64", "Name=\"normal\" NumberOfComponents=\"3\"",
                               lines_of(nodes.normals)) +
                vtk_data_array("Float64", "Name=\"area\"", areas) + "</PointData>\n");
  return text.str();
}

}  // namespace wscvt
