// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A part of the mesh connected through edges.
struct Component {
  std::size_t faces = 0;
  std::size_t boundary_edges = 0;
  std::size_t non_manifold_edges = 0;
  bool orientable = true;
  double volume = 0.0;  ///< signed; of the cone over one of its points where it is open; length^3
};

struct Components {
  std::vector<Component> list;        ///< in the order of their first faces
  std::vector<std::int32_t> of_face;  ///< for every face its place in `list`
  /// For every face 1 when it must be turned round so that all of its component look the same way
  /// as the component's first face.
  std::vector<char> turned;
};

/// Finds the parts and a consistent orientation of each. `rings` as edge_rings makes them. The same
/// on any number of threads.
Components find_components(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                           const Execution& execution);

/// Keeps the faces of one component, as they are; all points stay.
void keep_faces(IndexedMesh& mesh, const Components& components, std::size_t kept);

/// Keeps the faces of one component, turned outward, and the vertices they use, both in their
/// order. Returns how many were turned.
std::size_t keep_component(IndexedMesh& mesh, const Components& components, std::size_t kept);

}  // namespace wscvt
