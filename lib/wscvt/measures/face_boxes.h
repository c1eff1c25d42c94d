// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/mesh_place.h"

namespace wscvt {

/// The faces of a mesh in a binary tree of boxes, for the distances of many points one after the
/// other. Our own, because CGAL's AABB tree takes twice the time for the distances of a batch's
/// grains, given the same starts, and four times the time to be built over two million faces:
/// here nodes lie in memory in the order in which they are searched, and parts of the tree are made
/// at the same time. Const calls may come from several threads.
class FaceBoxes {
 public:
  /// Copies what it needs of the faces that have an area; about 150 bytes each. Reports `stage`.
  /// The same tree on any number of threads.
  FaceBoxes(const IndexedMesh& mesh, const Execution& execution, const std::string& stage);

  /// No face has an area.
  bool empty() const { return faces_.empty(); }

  /// The nearest point of the surface. There must be faces, here and below, which is not checked.
  Vector3 nearest_point(const Vector3& point) const;

  /// Distance to the nearest point of the surface, >= 0; length.
  double distance(const Vector3& point) const;

  /// The same of many points. Where they follow each other along a surface the search is shortest.
  std::vector<double> distances(const std::vector<Vector3>& points,
                                const Execution& execution) const;

  /// The square of `distance`, for points that each have a face near them from the search before:
  /// `face` is where the search starts, counted in the order of this tree from 0, and becomes the
  /// nearest. Where the square is at most `enough` the search may end with any face that near.
  double squared_distance(const Vector3& point, std::size_t& face, double enough) const;

  /// The point of a face, counted as above, that is nearest to `point`.
  Vector3 nearest_point_of(std::size_t face, const Vector3& point) const;

  /// All faces, counted as above, that are at most `distance` away.
  std::vector<std::size_t> faces_within(const Vector3& point, double distance) const;

  /// The places of the mesh nearest to points; its triangles are counted as there.
  std::vector<MeshPlace> nearest_places(const std::vector<Vector3>& points,
                                        const Execution& execution) const;

  /// How many faces a ray from `point` meets, decided exactly by CGAL; its direction is the same
  /// for all points. Odd inside a closed mesh.
  std::size_t faces_met(const Vector3& point) const;

 private:
  using Corners = std::array<Vector3, 3>;

  /// Only the last leaf may have fewer. With one the tree would take half as much memory again.
  static constexpr std::size_t faces_a_leaf = 2;

  /// Nodes stand in the order of a walk through the tree: after an inner node its first child with
  /// all that is under it, then the second.
  struct Node {
    Vector3 low;
    Vector3 high;
    std::int32_t beyond;  ///< the node after all that is under this one
    std::int32_t faces;   ///< the first of a leaf's; of an inner node -1

    double squared_distance(const Vector3& point) const {
      return (low - point).cwiseMax(point - high).cwiseMax(0.0).squaredNorm();
    }
  };

  class Builder;

  /// Calls visit(face) for the faces of a leaf.
  template <class Visit>
  void visit_faces(const Node& leaf, const Visit& visit) const {
    const auto begin = static_cast<std::size_t>(leaf.faces);
    const std::size_t end = std::min(begin + faces_a_leaf, faces_.size());
    for (std::size_t face = begin; face < end; ++face) visit(face);
  }
  std::size_t nearby_face(const Vector3& point) const;

  std::vector<Corners> faces_;         ///< in the order of the leaves
  std::vector<std::int32_t> numbers_;  ///< of these faces in the mesh
  std::vector<Node> nodes_;
};

}  // namespace wscvt
