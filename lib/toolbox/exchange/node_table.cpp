// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/node_table.h"

#include <sstream>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
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

namespace {

void check_frame(const MassProperties& mass, double radius) {
  const Eigen::Matrix3d& tensor = mass.inertia_tensor;
  const double off_diagonal = (tensor - Eigen::Matrix3d(tensor.diagonal().asDiagonal())).norm();
  if (mass.centroid.norm() <= 1e-6 * radius && off_diagonal <= 1e-6 * tensor.norm()) return;
  throw Error(ErrorCode::InvalidInput,
              "A Rockable shape has moments about the principal axes and no axes, but the grain is "
              "in another frame. Use the principal frame.");
}

}  // namespace

std::string rockable_shape(const std::string& name, const NodeTable& nodes,
                           const MassProperties& mass) {
  const double of_grain = equivalent_radius(mass.volume);
  check_frame(mass, of_grain);
  const double radius = 0.01 * of_grain;

  Vector3 lowest = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 highest = -lowest;
  std::string corners;
  for (std::size_t i = 0; i < nodes.mesh.points.size(); ++i) {
    const Vector3 corner = nodes.mesh.points[i] - radius * nodes.normals[i];
    lowest = lowest.cwiseMin(corner);
    highest = highest.cwiseMax(corner);
    corners += vector_text(corner) + "\n";
  }
  std::size_t edge_count = 0;
  std::string edges;
  std::string faces;
  for (const Triangle& t : nodes.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = t[k];
      const std::int32_t to = t[(k + 1) % 3];
      if (from > to) continue;  // once: the neighbouring triangle has it the other way round
      edges += std::to_string(from) + " " + std::to_string(to) + "\n";
      ++edge_count;
    }
    faces += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) +
             "\n";
  }
  const Vector3 extent = 0.5 * (highest - lowest) + Vector3::Constant(radius);
  const Vector3 moments = mass.inertia_tensor.diagonal() / mass.volume;
  return "<\nname " + name + "\nradius " + format_exact(radius) + "\npreCompDone y\nnv " +
         std::to_string(nodes.mesh.points.size()) + "\n" + corners + "ne " +
         std::to_string(edge_count) + "\n" + edges + "nf " +
         std::to_string(nodes.mesh.triangles.size()) + "\n" + faces + "obb.extent " +
         vector_text(extent) + "\nobb.e1 1 0 0\nobb.e2 0 1 0\nobb.e3 0 0 1\nobb.center " +
         vector_text(0.5 * (lowest + highest)) + "\nposition 0 0 0\norientation 1 0 0 0\nvolume " +
         format_exact(mass.volume) + "\nI/m " + vector_text(moments) + "\n>\n";
}

}  // namespace wscvt
