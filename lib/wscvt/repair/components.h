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
  double volume = 0.0;  ///< signed; if open, of the cone over one of its points; length^3
};

struct Components {
  std::vector<Component> list;        ///< in the order of their first faces
  std::vector<std::int32_t> of_face;  ///< for every face its index in `list`
  /// For every face 1 if it must be turned so that all faces of its component are oriented as the
  /// component's first face.
  std::vector<char> turned;
};

/// Finds the parts and a consistent orientation of each. `rings` as edge_rings returns them. The
/// result does not depend on the number of threads.
Components find_components(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                           const Execution& execution);

/// Keeps only the faces of one component, unchanged. All points stay.
void keep_faces(IndexedMesh& mesh, const Components& components, std::size_t kept);

/// Keeps only the faces of one component, turned outward, and their vertices. Both keep their
/// order. Returns the number of turned faces.
std::size_t keep_component(IndexedMesh& mesh, const Components& components, std::size_t kept);

/// Returns for every point 1 if it lies inside the closed oriented mesh (its winding number is not
/// 0). For points on the surface either result is possible. Faster than points times faces: it
/// visits the faces once, and for each point only the faces over it.
std::vector<char> are_inside(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                             const Execution& execution);

}  // namespace wscvt
