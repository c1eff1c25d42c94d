// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toolbox/conforming/dense_walls.h"
#include "toolbox/conforming/wall_mesh.h"
#include "wscvt/base/execution.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

/// Makes the edges of walls even: splits long edges, collapses short ones, flips, and moves nodes
/// within their walls and along their lines, always back onto the dense walls (after Botsch and
/// Kobbelt 2004, A remeshing approach to multiresolution modeling).
class WallRemesher {
 public:
  /// `dense` must outlive it. `edges`: the edge length of each grain; at a wall it is the geometric
  /// mean of both.
  WallRemesher(const DenseWalls& dense, std::vector<double> edges);

  /// Divides long edges and joins the ends of short ones, for dense walls of even triangles.
  void refine(const Execution& execution);

  /// Remeshes all walls from the dense ones. `least`: shortest edge length of each grain, about
  /// that of its dense walls. `nodes`: wanted of each grain; 0: the edge lengths decide.
  void run(const std::vector<double>& least, int nodes, const Execution& execution);

  WallMesh& mesh() { return mesh_; }

  /// Returns the mean over all edges of their length over the wanted one.
  double mean_ratio() const;

 private:
  double edge_of(const WallTriangle& t) const;
  double wanted(std::int32_t a, std::int32_t b) const;
  void collapse_short(double most);
  /// Takes away what is left of walls and lines of few voxels, and the walls with it.
  void collapse_narrow();
  /// Makes walls of one triangle even and not too small for tetrahedra. They are the contacts of a
  /// few faces of voxels.
  void widen_small();
  /// Joins the ends of an edge, see WallMesh::collapse. Returns whether it did.
  bool join(std::int32_t a, std::int32_t b, double longest, double evenness);
  void split_long();
  void flip_all(bool only_flat);
  void relax(int times, const Execution& execution);
  Vector3 relaxed(std::int32_t v) const;
  WallPoint placed(std::int32_t v, const Vector3& target) const;
  void find_edges(int nodes, const std::vector<double>& least);
  void improve(int rounds, const Execution& execution);

  const DenseWalls& dense_;
  std::vector<double> edges_;
  std::vector<double> first_edges_;
  double factor_ = 1.0;  ///< of all edge lengths, so that their mean is right
  WallMesh mesh_;
};

/// What finish_walls leaves.
struct FinishedWalls {
  std::vector<TrianglePair> pairs;  ///< triangles that intersect
  double volume_error = 0.0;        ///< largest, relative
};

/// Parts intersecting triangles and gives every grain its volume. Sheets of free surface move away
/// from each other, other nodes to the middle of their neighbours. Then the volumes are restored,
/// with smaller moves of the nodes that would make triangles intersect. `dense_edge`: of
/// the dense walls, such as a voxel's; length.
FinishedWalls finish_walls(WallMesh& mesh, const std::vector<double>& volumes, double dense_edge,
                           const Execution& execution);

}  // namespace wscvt
