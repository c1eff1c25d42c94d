// SPDX-License-Identifier: GPL-3.0-or-later
// half_edges SCAN: remeshes a half-edge mesh of OpenMesh with a property of one's own, and walks
// the result, which carries it: the valence of the nodes, and the sharpest edge.
#include <wscvt/mesh_files/mesh_io.h>
#include <wscvt/remesh.h>

#include <cmath>
#include <iostream>

int main(int /*count*/, char** arguments) try {
  wscvt::Mesh scan = wscvt::to_mesh(wscvt::read_mesh(arguments[1]));
  OpenMesh::VPropHandleT<double> height;
  scan.add_property(height, "height");
  for (const auto vertex : scan.vertices()) scan.property(height, vertex) = scan.point(vertex)[2];

  wscvt::RemeshOptions options;
  options.node_count = 500;
  wscvt::Mesh remeshed = wscvt::to_mesh(wscvt::remesh(scan, options));
  remeshed.get_property_handle(height, "height");

  unsigned neighbours = 0;
  for (const auto vertex : remeshed.vertices()) neighbours += remeshed.valence(vertex);
  remeshed.request_face_normals();
  remeshed.update_face_normals();
  double sharpest = 0.0;
  double at = 0.0;
  for (const auto edge : remeshed.edges()) {
    const double angle = std::abs(remeshed.calc_dihedral_angle(edge));
    if (angle <= sharpest) continue;
    sharpest = angle;
    at = remeshed.property(height, wscvt::Mesh::VertexHandle(edge.v0().idx()));
  }
  std::cout << remeshed.n_vertices() << " nodes with " << neighbours
            << " neighbours; the sharpest edge, " << sharpest << " rad, is at height " << at
            << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
