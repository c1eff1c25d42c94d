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

namespace wscvt {

struct MeshPlace;

/// Whether a face of the mesh has an area.
bool has_area(const IndexedMesh& mesh);

/// Computes exact distances from points to a triangle mesh, with its faces in a binary tree of
/// boxes. CGAL's AABB tree takes twice the time for the distances of a batch's grains, from the
/// same starts, and four times the time to build over two million faces. This tree stores nodes in
/// the order of the search, and builds parts at the same time. Const functions are thread-safe.
class MeshDistance {
 public:
  /// Copies the data of the faces that have an area, about 150 bytes per face. Reports `stage`. The
  /// tree does not depend on the number of threads. Throws Error(InvalidInput) if no face of the
  /// mesh has an area, and Error(Cancelled).
  explicit MeshDistance(const IndexedMesh& mesh, const Execution& execution = Execution(1),
                        const std::string& stage = "Measuring distances");

  /// Returns the distance to the nearest point of the surface, >= 0; length.
  double distance(const Vector3& point) const;

  /// Returns the distances of many points, on the threads of `execution`. Fastest if successive
  /// points are neighbours on a surface.
  std::vector<double> distances(const std::vector<Vector3>& points,
                                const Execution& execution) const;

  /// As `distances`, with the sign of the side: positive outside of the mesh, which must be closed.
  std::vector<double> signed_distances(const std::vector<Vector3>& points,
                                       const Execution& execution) const;

  /// Whether `point` is inside; the mesh must be closed. On the surface itself, either answer is
  /// possible.
  bool contains(const Vector3& point) const { return faces_met(point) % 2 == 1; }

  /// Returns the square of `distance`, for a point with a near face from an earlier search. The
  /// search starts at `face`, counted from 0 in the order of this tree, and sets it to the nearest
  /// face. If the square is at most `enough`, the search may end at any face that near.
  double squared_distance(const Vector3& point, std::size_t& face, double enough) const;

  /// Returns the point of a face, counted as above, that is nearest to `point`.
  Vector3 nearest_point_of(std::size_t face, const Vector3& point) const;

  /// Returns all faces, counted as above, that are at most `distance` away.
  std::vector<std::size_t> faces_within(const Vector3& point, double distance) const;

  /// Returns the places of the mesh nearest to points, with the mesh's triangle indices.
  std::vector<MeshPlace> nearest_places(const std::vector<Vector3>& points,
                                        const Execution& execution) const;

  /// Returns the number of faces that a ray from `point` hits, computed exactly by CGAL. The ray's
  /// direction is fixed. Odd inside a closed mesh.
  std::size_t faces_met(const Vector3& point) const;

 private:
  using Corners = std::array<Vector3, 3>;

  /// Only the last leaf may have fewer. With one face per leaf, the tree would need half as much
  /// memory again.
  static constexpr std::size_t faces_a_leaf = 2;

  /// Nodes are in depth-first order: after an inner node its first child's subtree, then the second
  /// child's.
  struct Node {
    Vector3 low;
    Vector3 high;
    std::int32_t beyond;  ///< the node after this one's subtree
    std::int32_t faces;   ///< the first face of a leaf; -1 for an inner node

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
  std::vector<std::int32_t> numbers_;  ///< index of each of these faces in the mesh
  std::vector<Node> nodes_;
};

/// Returns the square of the distance from a point to a face with an area; infinity if that is lost
/// in rounding.
double squared_distance_to_face(const std::array<Vector3, 3>& corners, const Vector3& point);

}  // namespace wscvt
