// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A closed mesh of genus 0, taken apart to a tetrahedron by half-edge collapses and put together
/// again one vertex after another (Hoppe 1996, "Progressive meshes"). A vertex leaves by moving on
/// to a neighbour, so that every stage has vertices of the scan; each stage is a closed 2-manifold
/// of genus 0. Every triangulation of the sphere comes down to four vertices: among the neighbours
/// of any vertex there is one that it may be collapsed to.
///
/// Half-edges are numbered as in half_edges.h; those of triangles that are not there at a stage
/// must not be asked for.
class MeshCollapse {
 public:
  /// Links the mesh and checks it; nothing is collapsed. Throws Error(InvalidInput) when an index
  /// is out of range, a point is not finite, or the triangles are not one closed, oriented
  /// 2-manifold of genus 0 with all points as corners.
  MeshCollapse(const IndexedMesh& mesh, const Execution& execution);

  /// Collapses the cheapest vertex again and again until `vertices` (at least 4) are left. A vertex
  /// costs its way to the neighbour, the surface behind it and the distance from the planes behind
  /// both (Garland and Heckbert 1997), more where triangles get thin or turn over and where a
  /// valence above nine arises. In time n log n whatever the valences.
  void collapse_to(std::size_t vertices, const Execution& execution);

  /// Takes back the last collapse that was not taken back yet, exactly: the same triangles and
  /// half-edges come back.
  struct Undone {
    std::int32_t vertex;     ///< that is there again
    std::int32_t neighbour;  ///< that it had been collapsed to
  };
  Undone undo();

  /// Collapses that have not been taken back.
  std::size_t collapses() const { return log_.size(); }
  /// Vertices that are there.
  std::size_t vertex_count() const { return alive_; }
  bool has_vertex(std::int32_t vertex) const { return first_[vertex] >= 0; }

  /// The scan's points about their mean, in the unit that gives its area 4 pi.
  const std::vector<Vector3>& points() const { return points_; }
  /// All triangles; those that are not there keep old corners.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<std::int32_t>& opposite() const { return opposite_; }
  /// The triangles that are there at this stage, in the order in which `undo` brings them back.
  /// Empty until `collapse_to` was called.
  const std::vector<std::int32_t>& present_triangles() const { return present_; }
  /// A half-edge that starts at a vertex that is there.
  std::int32_t first_half_edge(std::int32_t vertex) const { return first_[vertex]; }
  std::int32_t valence(std::int32_t vertex) const { return valences_[vertex]; }

  /// Calls visit(half_edge) for the half-edges that leave a vertex, counter-clockwise.
  template <class Visit>
  void visit_outgoing(std::int32_t vertex, const Visit& visit) const {
    wscvt::visit_outgoing(opposite_, first_[vertex], visit);
  }

  /// The mesh at this stage: the vertices that are there, in the input's order and at their
  /// `positions`, one for every vertex of the input.
  IndexedMesh present_mesh(const std::vector<Vector3>& positions) const;

 private:
  class Queue;

  void collapse(std::int32_t half_edge);
  /// 1 for every triangle that is not there.
  std::vector<char> absent_triangles() const;
  std::int32_t origin(std::int32_t half_edge) const { return origin_of(triangles_, half_edge); }
  std::int32_t target(std::int32_t half_edge) const { return target_of(triangles_, half_edge); }

  std::vector<Vector3> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> opposite_;
  std::vector<std::int32_t> first_;     ///< -1 for a vertex that is not there
  std::vector<std::int32_t> valences_;  ///< of the vertices that are there
  std::vector<std::int32_t> present_;
  std::vector<std::int32_t> log_;  ///< collapsed half-edges, which keep their corners and links
  std::size_t alive_ = 0;
};

}  // namespace wscvt
