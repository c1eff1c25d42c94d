// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

/// The triangles of a mesh in the cells of a grid that their boxes touch. Finds whether a single
/// triangle intersects others, thousands of times while the mesh changes. Uses rounded numbers; the
/// exact self_intersections checks the final mesh.
class TriangleHash {
 public:
  /// Enters all triangles of a mesh into cells with edges of `cell` > 0.
  void build(const EditMesh& mesh, double cell);
  /// Enters a changed triangle; its old cells keep it too, and tests use its current shape.
  void enter(const EditMesh& mesh, std::int32_t t);

  /// Returns whether a triangle with these corners intersects a triangle of the mesh outside what
  /// they share. `ids` are the vertices of the corners, -1 for a vertex in no triangle. Leaves out
  /// the triangles `but`, and all triangles of the vertex `moved` if it is not -1.
  bool meets(const EditMesh& mesh, const Triangle& ids, const std::array<Vector3, 3>& corners,
             const std::vector<std::int32_t>& but, std::int32_t moved = -1) const;

  /// Returns all pairs of intersecting triangles, the smaller number first, ascending, each once.
  /// No triangle may have moved since `build`. The result does not depend on the number of threads.
  std::vector<TrianglePair> pairs(const EditMesh& mesh, const Execution& execution) const;

 private:
  struct Entry {
    std::int32_t triangle;
    std::int32_t next;
  };
  using Box = Eigen::AlignedBox3d;
  static bool part(const Box& a, const Box& b) {
    // Without branches, which processors predict badly here.
    const auto apart = [&](int k) {
      return static_cast<unsigned>(a.min()[k] > b.max()[k]) |
             static_cast<unsigned>(b.min()[k] > a.max()[k]);
    };
    return (apart(0) | apart(1) | apart(2)) != 0U;
  }
  template <class Visit>
  void visit_cells(const Box& box, const Visit& visit) const;
  void find_pairs_of(const EditMesh& mesh, const std::vector<char>& embedded, std::int32_t t,
                     std::vector<TrianglePair>& found) const;
  std::size_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const;

  double cell_ = 1.0;
  std::size_t mask_ = 0;
  std::vector<std::int32_t> heads_;
  std::vector<Entry> entries_;
  std::vector<Box> boxes_;  ///< of each triangle when it was last entered
};

/// Returns whether two triangles intersect outside the corners with the same numbers, in rounded
/// numbers; false if they share two corners.
bool triangles_cross(const Triangle& a, const std::array<Vector3, 3>& x, const Triangle& b,
                     const std::array<Vector3, 3>& y);

}  // namespace wscvt
