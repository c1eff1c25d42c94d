// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "toolbox/convex/body_cut.h"
#include "toolbox/convex/cut_choice.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// The pieces of one part.
struct PieceGroup {
  std::vector<std::size_t> pieces;  ///< numbers of pieces of a CutTree
  ConvexBody body;                  ///< the hull of all of them
  double volume = 0.0;              ///< of the pieces, length^3
  double cost = 0.0;                ///< see HullCost
};

/// Returns the sum of the costs of the parts.
double total_cost(const std::vector<PieceGroup>& groups);

/// A grain cut by planes. Each plane cuts a piece left by earlier planes. If a plane is moved
/// later, the cuts after it are made again.
class CutTree {
 public:
  /// `mesh`: see convex_parts. `axes` has the axes of the grain as columns.
  CutTree(const IndexedMesh& mesh, const Eigen::Matrix3d& axes, const HullCost& cost);

  /// Cuts the piece of the highest cost repeatedly until there are `count` pieces, or few more;
  /// crumbs do not count. Does not cut pieces whose hull is within the tolerance of the grain.
  void cut(std::size_t count, const Execution& execution);

  /// Returns one group per piece. Omits flat pieces.
  std::vector<PieceGroup> groups() const;

  /// Moves and turns the planes as long as the total cost of the groups decreases.
  void move_planes(std::vector<PieceGroup>& groups, const Execution& execution);

  /// Cuts another mesh of the same grain, such as its scan, by the planes, and returns the groups
  /// with bodies and volumes of that mesh. A body may be empty. Throws Error(InvalidInput) if the
  /// mesh is not closed.
  std::vector<PieceGroup> groups_of(const IndexedMesh& mesh, const std::vector<PieceGroup>& groups,
                                    const Execution& execution) const;

 private:
  struct Node {
    CutSolid solid;
    ConvexBody body;
    CutPlane plane;                  ///< cuts the solid
    std::vector<std::size_t> above;  ///< pieces above the plane
    std::vector<std::size_t> below;
    bool is_piece() const { return above.empty(); }
  };
  using Solids = std::vector<std::pair<std::size_t, CutSolid>>;
  struct Trial;

  void add_node(CutSolid solid);
  bool cut_again(std::size_t node, CutSolid solid, const CutPlane& plane, Solids& solids) const;
  Trial trial(std::size_t node, const CutPlane& plane, const std::vector<PieceGroup>& groups,
              const std::vector<std::size_t>& group_of) const;
  bool move_plane(std::size_t node, double step, std::vector<PieceGroup>& groups,
                  const std::vector<std::size_t>& group_of, const Execution& execution);
  std::vector<std::size_t> group_of_nodes(const std::vector<PieceGroup>& groups) const;
  void collect(std::size_t node, const CutSolid& solid, const std::vector<std::size_t>& group_of,
               std::vector<PieceGroup>& groups, std::vector<std::vector<Vector3>>& points,
               const Execution& execution) const;

  std::vector<Node> nodes_;
  Eigen::Matrix3d axes_;
  HullCost cost_;
};

}  // namespace wscvt
