// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Traits of the public mesh type: double coordinates, colours of three bytes.
struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  using Color = OpenMesh::Vec3uc;
};

/// The public half-edge type, for code that walks over a mesh. remesh takes one, and to_mesh makes
/// one of a result.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

/// Builds the half-edge mesh and keeps the order of vertices and faces. Each attribute becomes a
/// property of its name: of double or float if it holds fractions, else of int. "red", "green" and
/// "blue" of whole numbers become OpenMesh's colours instead. A texture is left out. Throws
/// Error(InvalidInput) if the triangles are no oriented 2-manifold, an index is out of range, or
/// the number of values differs from that of the vertices or faces.
Mesh to_mesh(const IndexedMesh& mesh, const MeshAttributes& attributes = {});

/// Copies a half-edge mesh into flat arrays, without deleted elements. Keeps the order of vertices
/// and faces.
IndexedMesh to_indexed(const Mesh& mesh);

/// Copies the colours and the properties of double, float and int of a half-edge mesh, in the order
/// of to_indexed.
MeshAttributes attributes_of(const Mesh& mesh);

}  // namespace wscvt
