// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <vector>

#include "toolbox/conforming/dense_walls.h"
#include "wscvt/base/half_edges.h"

namespace wscvt {

/// A few numbers; almost always without memory of their own.
template <class Number>
using FewOf = boost::container::small_vector<Number, 16>;
using EdgeTriangles = FewOf<std::size_t>;
using WallVertices = FewOf<std::int32_t>;

inline constexpr double usual_least_cosine = 0.5;

/// The walls as triangles that can be changed. Every change keeps what touches what: each grain
/// stays a closed manifold, and walls keep their lines and points.
class WallMesh : public WallComplex {  // dead triangles have the corner -1
 public:
  /// `dense` must outlive it.
  explicit WallMesh(const DenseWalls& dense);

  std::size_t vertex_count() const { return points.size(); }
  bool is_alive(std::size_t t) const { return triangles[t].corners[0] >= 0; }

  /// Calls visit(t) for each triangle at a vertex.
  template <class Visit>
  void visit_triangles(std::int32_t v, const Visit& visit) const {
    for (std::int32_t c = first_[v]; c >= 0; c = next_[c]) visit(index(c) / 3);
  }

  /// Returns the triangles at an edge.
  EdgeTriangles triangles_at(std::int32_t a, std::int32_t b) const;

  /// Returns the neighbours of a vertex that is on a line, along lines.
  WallVertices line_neighbours(std::int32_t v) const;

  /// Whether the triangles of an edge make it part of a line.
  bool is_line(const EdgeTriangles& at_edge) const;

  /// Whether a triangle is a whole wall between two grains.
  bool is_alone(std::size_t t) const;

  /// Joins `gone` with `kept` at a position, if nothing but the triangles at their edge vanishes,
  /// no triangle turns over or becomes a sliver (its evenness gets worse and is below `evenness`; 0
  /// flat, 1 even edges), and no edge becomes too long. Returns whether it did.
  bool collapse(std::int32_t gone, std::int32_t kept, const Vector3& position, double longest,
                double evenness);

  /// Adds a node in the middle of an edge.
  std::int32_t split(std::int32_t a, std::int32_t b);

  /// Turns the edge of two triangles of one wall to their other corners, if their shape gets better
  /// and the surface does not bend more. Returns whether it did.
  bool flip(std::int32_t a, std::int32_t b);

  /// Returns 1 for a triangle of even edges, 0 for a flat one.
  double evenness_of(std::size_t t) const;

  /// Whether the two triangles of an edge within a wall are in one plane, or one has no area.
  bool is_flat(std::int32_t a, std::int32_t b) const;

  /// Returns whether a triangle may become one with the corners at `x`: its normal agrees with the
  /// dense walls at the corners within its wall, or does not agree less than now. Without such
  /// corners it may turn by an angle of the cosine `turn`. `least`: see collapse.
  bool may_become(std::size_t t, const Triangle& corners, const std::array<Vector3, 3>& x,
                  double turn, double least) const;

  /// Removes dead triangles and vertices without triangles.
  void compact();

  /// Whether collapses may join points, and lines with a narrow wall between them. Bodies stay
  /// closed manifolds.
  bool drops_walls = false;
  /// Collapses turn triangles by less than the angle of this cosine.
  double least_cosine = usual_least_cosine;
  /// Whether normals must agree with the dense walls after a collapse.
  bool follows_dense = true;
  std::vector<WallPlace> places;      ///< of the vertices
  std::vector<std::int32_t> anchors;  ///< a vertex of the dense walls near each vertex

 private:
  void link();
  void enter(std::size_t t, std::size_t k);
  void remove(std::size_t t, std::size_t k);
  void kill(std::size_t t);
  std::size_t corner(std::size_t t, std::int32_t v) const;
  Vector3 normal_of(std::size_t t) const;  ///< its length is twice the area
  bool is_sliver(std::size_t t) const;     ///< left by a cut; there are none among voxels
  bool keeps_lines(std::int32_t gone, std::int32_t kept, const EdgeTriangles& at_edge) const;
  bool keeps_bodies(std::int32_t gone, std::int32_t kept, const EdgeTriangles& at_edge) const;
  bool keeps_links(std::int32_t gone, std::int32_t kept, const EdgeTriangles& at_edge) const;
  bool keeps_shape(std::int32_t moved, std::int32_t other, std::int32_t into,
                   const Vector3& position, double longest, double least) const;

  double agreement(const Triangle& corners, const Vector3& normal) const;

  const DenseWalls& dense_;
  std::vector<std::int32_t> first_;  ///< 3 t + k of a vertex; -1: none
  std::vector<std::int32_t> next_;   ///< of the same vertex, by 3 t + k
};

}  // namespace wscvt
