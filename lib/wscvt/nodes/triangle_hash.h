// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/edit_mesh.h"
#include "wscvt/nodes/self_intersections.h"

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

  /// All pairs of triangles that meet, the smaller number first, ascending, each once. No triangle
  /// has moved since `build`. The same on any number of threads.
  std::vector<TrianglePair> pairs(const EditMesh& mesh, const Execution& execution) const;

 private:
  struct Entry {
    std::int32_t triangle;
    std::int32_t next;
  };
  struct Box {
    Vector3 low;
    Vector3 high;
  };
  static Box box_of(const std::array<Vector3, 3>& corners);
  static bool part(const Box& a, const Box& b) {
    // Without branches, of which no processor foresees the way.
    const auto apart = [&](int k) {
      return static_cast<unsigned>(a.low[k] > b.high[k]) |
             static_cast<unsigned>(b.low[k] > a.high[k]);
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
  std::vector<Box> boxes_;  ///< of each triangle as it was entered last
};

/// Whether two triangles meet elsewhere than in the corners they share by number, in rounded
/// numbers; those that share two corners do not.
bool triangles_cross(const Triangle& a, const std::array<Vector3, 3>& x, const Triangle& b,
                     const std::array<Vector3, 3>& y);

}  // namespace wscvt
