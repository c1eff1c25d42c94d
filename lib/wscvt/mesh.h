// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <array>
#include <cstdint>
#include <vector>

namespace wscvt {

using Vector3 = Eigen::Vector3d;

/// Three indices into the points, counter-clockwise seen from outside.
using Triangle = std::array<std::int32_t, 3>;

/// Traits of the public mesh type: double coordinates.
struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

/// The public mesh type: what the remesher returns.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

/// Points and triangles in flat arrays: the form in which a dense scan is held (no half-edges) and
/// in which geometry is computed.
struct IndexedMesh {
  std::vector<Vector3> points;
  std::vector<Triangle> triangles;
};

/// Builds the half-edge mesh, vertices and faces in the same order. Throws Error(InvalidInput) when
/// the triangles are not those of an oriented 2-manifold or an index is out of range.
Mesh to_mesh(const IndexedMesh& mesh);

/// Flat copy of a half-edge mesh without deleted elements, vertices and faces in the same order.
IndexedMesh to_indexed(const Mesh& mesh);

}  // namespace wscvt
