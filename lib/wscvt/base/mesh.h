// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Traits of the public mesh type: double coordinates.
struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

/// The public half-edge type, for code that walks over a mesh. to_mesh converts a result.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

/// Builds the half-edge mesh and keeps the order of vertices and faces. Throws Error(InvalidInput)
/// if the triangles are no oriented 2-manifold or an index is out of range.
Mesh to_mesh(const IndexedMesh& mesh);

/// Copies a half-edge mesh into flat arrays, without deleted elements. Keeps the order of vertices
/// and faces.
IndexedMesh to_indexed(const Mesh& mesh);

}  // namespace wscvt
