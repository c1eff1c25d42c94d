// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The faces of a mesh in a binary tree of boxes, for the distances of many points one after the
/// other. Takes half the time of CGAL's tree, which MeshDistance has, where that is given the same
/// starts and a kernel without exact predicates: nodes lie in memory in the order in which they are
/// searched. Const calls may come from several threads.
class FaceBoxes {
 public:
  /// Copies what it needs of the faces that have an area; about 220 bytes each. Reports `stage`,
  /// and takes one thread.
  FaceBoxes(const IndexedMesh& mesh, const Execution& execution, const std::string& stage);

  /// No face has an area.
  bool empty() const { return faces_.empty(); }

  /// Distances from points to the nearest points of the surface, >= 0; length. Where points follow
  /// each other along a surface the search is shortest. There must be faces, which is not checked.
  std::vector<double> distances(const std::vector<Vector3>& points,
                                const Execution& execution) const;

 private:
  using Corners = std::array<Vector3, 3>;

  /// Nodes stand in the order of a walk through the tree: after an inner node its first child with
  /// all that is under it, then the second.
  struct Node {
    Vector3 low;
    Vector3 high;
    std::int32_t beyond;  ///< the node after all that is under this one
    std::int32_t face;    ///< of a leaf; of an inner node -1

    double squared_distance(const Vector3& point) const {
      return (low - point).cwiseMax(point - high).cwiseMax(0.0).squaredNorm();
    }
  };

  void build(std::size_t begin, std::size_t end, const Execution& execution,
             const std::string& stage);
  std::size_t nearby_face(const Vector3& point) const;
  /// `face` is where the search starts, and becomes the nearest one.
  double distance(const Vector3& point, std::size_t& face) const;

  std::vector<Corners> faces_;  ///< in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace wscvt
