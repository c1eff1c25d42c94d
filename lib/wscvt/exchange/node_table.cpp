// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/exchange/node_table.h"

#include <utility>

#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

std::string data_array(const std::string& type, const std::string& attributes,
                       const std::string& numbers) {
  return "<DataArray type=\"" + type + "\" " + attributes + " format=\"ascii\">\n" + numbers +
         "</DataArray>\n";
}

std::string lines_of(const std::vector<Vector3>& vectors) {
  std::string text;
  for (const Vector3& v : vectors) {
    text += format_exact(v.x()) + " " + format_exact(v.y()) + " " + format_exact(v.z()) + "\n";
  }
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
  std::string corners;
  std::string ends;
  for (std::size_t t = 0; t < nodes.mesh.triangles.size(); ++t) {
    const Triangle& corner = nodes.mesh.triangles[t];
    corners += std::to_string(corner[0]) + " " + std::to_string(corner[1]) + " " +
               std::to_string(corner[2]) + "\n";
    ends += std::to_string(3 * (t + 1)) + "\n";
  }
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
         "<PolyData>\n<Piece NumberOfPoints=\"" +
         std::to_string(nodes.mesh.points.size()) +
         "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
         std::to_string(nodes.mesh.triangles.size()) +
         "\">\n<PointData Normals=\"normal\" Scalars=\"area\">\n" +
         data_array("Float64", "Name=\"normal\" NumberOfComponents=\"3\"",
                    lines_of(nodes.normals)) +
         data_array("Float64", "Name=\"area\"", areas) + "</PointData>\n<Points>\n" +
         data_array("Float64", "Name=\"Points\" NumberOfComponents=\"3\"",
                    lines_of(nodes.mesh.points)) +
         "</Points>\n<Polys>\n" + data_array("Int64", "Name=\"connectivity\"", corners) +
         data_array("Int64", "Name=\"offsets\"", ends) +
         "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

}  // namespace wscvt
