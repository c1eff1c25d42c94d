// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A plane: the points p with normal . p = offset.
struct CutPlane {
  Vector3 normal = Vector3::UnitX();  ///< unit
  double offset = 0.0;
};

/// A solid that planes cut, with exact coordinates: rounded ones would make caps that are not flat,
/// and the next cut would fail there. Cheap to copy.
class ExactSolid {
 public:
  /// Of a closed outward mesh. `is_solid` is false if its triangles are those of no manifold.
  explicit ExactSolid(const IndexedMesh& mesh);

  bool is_solid() const { return exact_ != nullptr; }

  /// Closed, outward; coordinates rounded.
  const IndexedMesh& mesh() const { return mesh_; }

  /// The connected pieces on both sides of a plane (CGAL's clip, with caps). None if the plane
  /// misses the solid or the cut failed. Deterministic.
  std::vector<ExactSolid> cut(const CutPlane& plane) const;

 private:
  struct Exact;
  ExactSolid(IndexedMesh mesh, std::shared_ptr<const Exact> exact);

  IndexedMesh mesh_;
  std::shared_ptr<const Exact> exact_;
};

}  // namespace wscvt
