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

/// The public half-edge type, for those who walk over a mesh: to_mesh makes one of a result.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

/// Builds the half-edge mesh, vertices and faces in the same order. Throws Error(InvalidInput) when
/// the triangles are not those of an oriented 2-manifold or an index is out of range.
Mesh to_mesh(const IndexedMesh& mesh);

/// Flat copy of a half-edge mesh without deleted elements, vertices and faces in the same order.
IndexedMesh to_indexed(const Mesh& mesh);

}  // namespace wscvt
