// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// What steps of nodes may do to their triangles.
struct StepLimits {
  /// No triangle comes to a smaller angle than this, or than it has if that is smaller; degrees, in
  /// [0, 60).
  double smallest_angle = 0.0;
  /// No edge's faces come to turn against each other by more than this, or than they do if that is
  /// more; degrees, in (0, 180].
  double largest_turn = 180.0;
};

/// Steps that all nodes of a closed, oriented 2-manifold take at once, each as much of its own as
/// the limits allow: where these are violated, the nodes concerned take a half, a quarter, ... of
/// their step, and at last none.
class GuardedSteps {
 public:
  /// `steps` has one a node; nodes and half-edges must outlive this.
  GuardedSteps(const IndexedMesh& nodes, const HalfEdges& half_edges, std::vector<Vector3> steps,
               const StepLimits& limits, const Execution& execution);

  /// Where the nodes come to. Those that this holds back stay held back. Throws Error(Cancelled).
  std::vector<Vector3> positions();

  /// Lets a node take half as much from here on; false when it takes nothing as it is.
  bool hold_back(std::int32_t node);
  /// How many nodes take less than their whole step.
  int held_back() const;

 private:
  /// The smallest angle of each triangle and the turn at each half-edge, as cosines.
  struct Shape {
    std::vector<double> angles;
    std::vector<double> turns;
  };
  Shape shape_of(const std::vector<Vector3>& points) const;

  const IndexedMesh& nodes_;
  const HalfEdges& half_edges_;
  Execution execution_;  // a copy: callers may pass a temporary
  std::vector<Vector3> steps_;
  std::vector<int> halvings_;  ///< of each node's step
  double angle_cosine_;        ///< of the limits
  double turn_cosine_;
  Shape before_;
};

}  // namespace wscvt
