// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A closed mesh of genus 0 that half-edge collapses reduce to a tetrahedron and that is restored
/// one vertex after another (Hoppe 1996, "Progressive meshes"). A collapse merges a vertex into a
/// neighbour, so every stage has only vertices of the scan. Each stage is a closed 2-manifold of
/// genus 0. Every triangulation of the sphere can be reduced to four vertices, because any vertex
/// may be collapsed to one of its neighbours.
///
/// Half-edges are numbered as in half_edges.h. Do not use half-edges of triangles that do not exist
/// at a stage.
class MeshCollapse {
 public:
  /// Links and checks the mesh; collapses nothing. Throws Error(InvalidInput) if an index is out of
  /// range, a point is not finite, or the triangles are not one closed, oriented 2-manifold of
  /// genus 0 with all points as corners.
  MeshCollapse(const IndexedMesh& mesh, const Execution& execution);

  /// Collapses the cheapest vertex repeatedly until `vertices` (at least 4) are left. The cost has
  /// the distance to the neighbour, the surface that the vertex represents and the distance from
  /// the planes of both (Garland and Heckbert 1997). It is higher if triangles become thin or turn
  /// over, or a valence exceeds nine. Takes time n log n for any valences.
  void collapse_to(std::size_t vertices, const Execution& execution);

  /// Undoes the last collapse that was not undone yet. Restores exactly the same triangles and
  /// half-edges.
  struct Undone {
    std::int32_t vertex;     ///< the restored vertex
    std::int32_t neighbour;  ///< to which it had been collapsed
  };
  Undone undo();

  /// Returns the number of collapses that were not undone.
  std::size_t collapses() const { return log_.size(); }
  /// Returns the number of vertices at this stage.
  std::size_t vertex_count() const { return alive_; }
  bool has_vertex(std::int32_t vertex) const { return first_[vertex] >= 0; }

  /// The scan's points about their mean, in the unit that gives its area 4 pi.
  const std::vector<Vector3>& points() const { return points_; }
  /// All triangles; triangles that do not exist at this stage keep old corners.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<std::int32_t>& opposite() const { return opposite_; }
  /// The triangles of this stage, in the order in which `undo` restores them. Empty before
  /// `collapse_to`.
  const std::vector<std::int32_t>& present_triangles() const { return present_; }
  /// Returns a half-edge that starts at a vertex of this stage.
  std::int32_t first_half_edge(std::int32_t vertex) const { return first_[vertex]; }
  std::int32_t valence(std::int32_t vertex) const { return valences_[vertex]; }
  /// Returns the vertex to which a half-edge leads.
  std::int32_t target(std::int32_t half_edge) const { return target_of(triangles_, half_edge); }

  /// Calls visit(half_edge) for the half-edges that leave a vertex, counter-clockwise.
  template <class Visit>
  void visit_outgoing(std::int32_t vertex, const Visit& visit) const {
    wscvt::visit_outgoing(opposite_, first_[vertex], visit);
  }

 private:
  class Queue;

  void collapse(std::int32_t half_edge);
  /// Returns 1 for every triangle that does not exist at this stage.
  std::vector<char> absent_triangles() const;
  std::int32_t origin(std::int32_t half_edge) const { return origin_of(triangles_, half_edge); }

  std::vector<Vector3> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> opposite_;
  std::vector<std::int32_t> first_;     ///< -1 for a vertex that does not exist
  std::vector<std::int32_t> valences_;  ///< of the vertices that exist
  std::vector<std::int32_t> present_;
  std::vector<std::int32_t> log_;  ///< collapsed half-edges, which keep their corners and links
  std::size_t alive_ = 0;
};

}  // namespace wscvt
