// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// From one point to another, by their numbers.
using FaceEdge = std::array<std::int32_t, 2>;

/// The edges of a planar face: closed loops, counter-clockwise seen from outside, clockwise about a
/// hole.
using FaceEdges = std::vector<FaceEdge>;

/// Returns a number that only this directed edge has.
inline std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32U) |
         static_cast<std::uint32_t>(b);
}

/// Throws Error(InvalidInput) unless each edge of the triangles has two of them, one in each
/// direction.
void require_closed(const std::vector<Triangle>& triangles);

/// Returns twice the area of closed loops, along their normal. There must be an edge.
Vector3 doubled_area(const std::vector<Vector3>& points, const FaceEdge* first,
                     const FaceEdge* last);
inline Vector3 doubled_area(const std::vector<Vector3>& points, const FaceEdges& edges) {
  return doubled_area(points, edges.data(), edges.data() + edges.size());
}

/// Returns closed loops of directed edges, in the order of their first edges.
std::vector<FaceEdges> loops_of(const FaceEdges& edges);

/// Returns the faces of a plane from all their edges: each outer loop is a face, with the holes in
/// it.
std::vector<FaceEdges> faces_of(const std::vector<Vector3>& points, const FaceEdges& edges,
                                const Vector3& normal);

/// Parts of a face on both sides of a plane. The pairs down[k], up[k] bound the plane's own face.
struct FaceParts {
  FaceEdges above;
  FaceEdges below;
  std::vector<std::int32_t> down;  ///< points at which the edges go below
  std::vector<std::int32_t> up;
};

/// Cuts faces that share points. An edge gets one point, so faces that share edges still do.
class FaceCutter {
 public:
  /// `heights`: of the points above the plane, length. Points at `on_plane` or lower count as
  /// below. Cuts append to `points`, which must outlive the cutter.
  FaceCutter(std::vector<Vector3>& points, const std::vector<double>& heights, double on_plane)
      : points_(points), heights_(heights), on_plane_(on_plane) {}

  bool is_above(std::int32_t point) const { return heights_[point] > on_plane_; }

  /// Divides a face of points that have heights. `along`: a direction of the line in which face and
  /// plane meet, the face's normal x the plane's. `parts` keeps its memory between calls.
  void divide(const FaceEdge* first, const FaceEdge* last, const Vector3& along, FaceParts& parts);

 private:
  std::int32_t crossing(std::int32_t a, std::int32_t b);

  std::vector<Vector3>& points_;
  const std::vector<double>& heights_;
  double on_plane_;
  std::unordered_map<std::uint64_t, std::int32_t> crossings_;
};

}  // namespace wscvt
