// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/mesh.h"

#include <string>

#include "wscvt/base/error.h"

namespace wscvt {

Mesh to_mesh(const IndexedMesh& mesh) {
  Mesh result;
  const std::size_t vertices = mesh.points.size();
  const std::size_t faces = mesh.triangles.size();
  result.reserve(vertices, 3 * faces / 2 + 1, faces);
  for (const Vector3& p : mesh.points) result.new_vertex(Mesh::Point(p.x(), p.y(), p.z()));
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& t = mesh.triangles[f];
    for (const std::int32_t v : t) {
      if (v < 0 || static_cast<std::size_t>(v) >= vertices) {
        throw Error(ErrorCode::InvalidInput, "Triangle " + std::to_string(f) + " names vertex " +
                                                 std::to_string(v) + ", but the mesh has " +
                                                 std::to_string(vertices) + " vertices.");
      }
    }
    const auto face = result.add_face(Mesh::VertexHandle(t[0]), Mesh::VertexHandle(t[1]),
                                      Mesh::VertexHandle(t[2]));
    if (!face.is_valid()) {
      throw Error(ErrorCode::InvalidInput,
                  "Triangle " + std::to_string(f) +
                      " does not fit an oriented 2-manifold. Check and repair the mesh first.");
    }
  }
  return result;
}

IndexedMesh to_indexed(const Mesh& mesh) {
  IndexedMesh result;
  result.points.reserve(mesh.n_vertices());
  result.triangles.reserve(mesh.n_faces());
  for (const auto vertex : mesh.all_vertices()) {
    const Mesh::Point& p = mesh.point(vertex);
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto face : mesh.all_faces()) {
    Triangle t{};
    std::size_t k = 0;
    for (const auto vertex : mesh.fv_range(face)) t[k++] = vertex.idx();
    result.triangles.push_back(t);
  }
  return result;
}

}  // namespace wscvt
