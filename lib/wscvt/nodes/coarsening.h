// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// A closed surface coarsened on its own triangles by merging vertices: Ward's clusters (Ward 1963,
/// J. Am. Stat. Assoc. 58, 236). A vertex represents a cluster of the scan's vertices and is their
/// centroid, but a cluster over a thin rim stays on the rim. The next merge adds least to the sum
/// of their squared distances from it. For points distributed over a surface, this is close to a
/// centroidal Voronoi tessellation.
///
/// Masses are areas, or areas times the square of the wanted density of nodes. The cells of an
/// optimal quantizer in the plane then have the wanted density (Gersho 1979, IEEE Trans. Inf.
/// Theory 25, 373).
///
/// Never merges across a handle or from sheet to sheet, so that the genus stays. Copyable: a search
/// for a number of nodes continues from a copy.
class Coarsening {
 public:
  /// `density`: wanted density of nodes at each vertex, mean over the surface 1; empty: uniform.
  Coarsening(EditMesh scan, const std::vector<double>& density);

  const EditMesh& mesh() const { return mesh_; }
  std::size_t size() const { return static_cast<std::size_t>(alive_); }
  /// Area and vector area of each vertex's cluster.
  const std::vector<double>& areas() const { return areas_; }
  const std::vector<Vector3>& vectors() const { return vectors_; }

  /// Merges cheap pairs, which about halves the vertices but leaves at least `least`, then flips to
  /// Delaunay. Returns the number of merges.
  int sweep(int least);
  /// Merges the cheapest pairs until `count` vertices are left. Returns whether it succeeded.
  bool reduce(int count, const Execution& execution);
  /// Later merges only keep the surface a manifold, whatever the shapes: the last resort for few
  /// nodes.
  void ignore_shapes() { ignores_shapes_ = true; }
  /// Returns the vertex that now represents a vertex of the mesh as it was at construction or at
  /// the last `forget`.
  std::int32_t cluster_of(std::int32_t vertex) const {
    return clusters_.empty() ? vertex : clusters_[vertex];
  }
  /// Numbers of cluster_of refer to the current vertices from now on. Frees the memory of the
  /// others. Returns cluster_of for each vertex until now; empty: identical.
  std::vector<std::int32_t> forget();

 private:
  struct Merge {
    double cost;
    std::int32_t v;
    std::int32_t w;
    std::int32_t time;
  };
  class Queue;

  bool is_merged(std::int32_t v) const { return mesh_.first[v] < 0; }
  double mass(std::int32_t v) const { return masses_.empty() ? areas_[v] : masses_[v]; }
  Vector3 merged(std::int32_t v, std::int32_t w) const;
  double cost(std::int32_t v, std::int32_t w) const;
  bool possible(std::int32_t v, std::int32_t w);
  bool common_neighbours_allow(std::int32_t v, std::int32_t w);
  struct FanShape;
  FanShape shape_of(std::int32_t v, std::int32_t w, bool are_merged, double large) const;
  void merge(std::int32_t v, std::int32_t w);
  /// Returns the cheapest merge at a vertex after the one of this cost with `last`, possible or
  /// not; `w` is -1 if there is none.
  Merge cheapest_after(std::int32_t v, double cost, std::int32_t last) const;
  void renumber_faces();
  void compact();

  // A scan of millions of vertices is held here a second time, so marks have no arrays of their
  // own. `first` of a vertex that was merged into w is -1 - w. The first corner of a free triangle
  // is -1.
  EditMesh mesh_;
  int alive_ = 0;
  bool ignores_shapes_ = false;
  double area_ = 0.0;
  std::vector<double> areas_;
  std::vector<double> masses_;  ///< empty: the areas
  std::vector<Vector3> vectors_;
  std::vector<std::int32_t> ring_;      ///< the neighbours of a vertex
  std::vector<std::int32_t> clusters_;  ///< see cluster_of; empty: identical
};

}  // namespace wscvt
