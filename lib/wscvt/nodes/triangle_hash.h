// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wscvt/nodes/edit_mesh.h"

namespace wscvt {

/// The triangles of a mesh by the cells of a grid that their boxes touch, to ask of a single
/// triangle whether it meets others, thousands of times while the mesh changes. Decides in rounded
/// numbers; self_intersections is exact and looks in the end.
class TriangleHash {
 public:
  /// Enters all triangles of a mesh into cells of the given edge > 0.
  void build(const EditMesh& mesh, double cell);
  /// Enters a triangle that has changed; where it was before it is tested as it stands.
  void enter(const EditMesh& mesh, std::int32_t t);

  /// Whether a triangle with these corners meets one of the mesh elsewhere than in what they share:
  /// `ids` are the vertices there, -1 for one that is in no triangle. Left out are the triangles
  /// `but`, and those about the vertex `moved` if not -1.
  bool meets(const EditMesh& mesh, const Triangle& ids, const std::array<Vector3, 3>& corners,
             const std::vector<std::int32_t>& but, std::int32_t moved = -1) const;

  /// The triangles above `t` in number that meet it, ascending, each once.
  std::vector<std::int32_t> meeting(const EditMesh& mesh, std::int32_t t) const;

 private:
  struct Entry {
    std::int32_t triangle;
    std::int32_t next;
  };
  template <class Visit>
  void visit_cells(const std::array<Vector3, 3>& corners, const Visit& visit) const;
  std::size_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const;

  double cell_ = 1.0;
  std::size_t mask_ = 0;
  std::vector<std::int32_t> heads_;
  std::vector<Entry> entries_;
};

/// Whether two triangles meet elsewhere than in the corners they share by number, in rounded
/// numbers; those that share two corners do not.
bool triangles_cross(const Triangle& a, const std::array<Vector3, 3>& x, const Triangle& b,
                     const std::array<Vector3, 3>& y);

}  // namespace wscvt
