// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/refinement_facet.h"
#include "wscvt/nodes/refinement_samples.h"
#include "wscvt/nodes/refinement_state.h"

namespace wscvt {

/// What the triangles of a fan must keep to.
struct FanLimits {
  double largest_cosine = 1.0;  ///< of their smallest angle
  double turn = 1.0;            ///< cosine at the edge that turned most before, see may_turn
};

/// The triangles about one node, counter-clockwise: the node, ring[j] and ring[j + 1] make the
/// j-th. As long as none of them turns over they cover the same directions wherever the node goes,
/// so that a move changes nothing but their own samples.
struct RefinementFan {
  std::vector<std::int32_t> ring;
  std::vector<std::int32_t> beside;  ///< the triangles across the edges of the ring
  std::vector<Vector3> outer;        ///< their unit normals
  RefinementNode node;
  std::vector<RefinementFacet> facets;  ///< per triangle, as the next two
  std::vector<double> errors;
  std::vector<SampleList> lists;  ///< may be longer than the ring, with empty ones: room is kept
  double node_error = 0.0;
  double error = 0.0;  ///< of the triangles and the node

  /// Room for as many triangles as the ring has.
  void resize();

  /// The smallest cosine of the turn at an edge, those of the ring too.
  double turn() const;
};

/// Room to work in, one a thread, so that trying places needs no allocation.
struct FanWorkspace {
  RefinementFan fan;
  RefinementFan trial;
  std::vector<Vector3>
      spokes;  ///< normals of the planes through the directions of node and ring[j]
  std::vector<std::int32_t> triangles;  ///< of the fan, in the triangulation
  std::vector<std::int32_t> outer;      ///< the half-edges across its ring, likewise
  std::vector<RefinementFacet> joined;  ///< what stands in the place of a fan whose node goes
};

/// Puts a node's fan as it is into work.fan, its triangles into work.triangles, and returns the
/// limits that leave it no worse than it is.
FanLimits load_fan(const RefinementState& state, std::int32_t node, FanWorkspace& work);

/// The same without the lists of samples, for those who read them where they are: copying them took
/// a twelfth of a refinement.
FanLimits load_facets(const RefinementState& state, std::int32_t node, FanWorkspace& work);

/// Puts work.fan back: what was loaded with load_fan and moved since. Its lists are then others.
void store_fan(RefinementState& state, std::int32_t node, FanWorkspace& work);

/// The fan `from` with its node at `position` and its samples dealt out anew; false when a triangle
/// would turn over or one exceed the limits. `to` is then of no use.
bool place_fan(const RefinementState& state, const RefinementFan& from, const Vector3& position,
               const FanLimits& limits, RefinementFan& to, std::vector<Vector3>& spokes);

/// Adds what small angles of a fan's triangles count to the system of its node's Gauss-Newton step.
void add_angles(const RefinementState& state, const RefinementFan& fan, const AnglePenalty& penalty,
                Matrix3& matrix, Vector3& gradient);

/// One Gauss-Newton step of work.fan's node, shortened until it lowers the fan's error; false, and
/// nothing changed, when three lengths do not.
bool improve_fan(const RefinementState& state, FanWorkspace& work, const FanLimits& limits);

/// Takes work.fan's node to the sample that is farthest from its triangle, or half the way there,
/// where that sample's distance counts more than its square and the fan's error falls: the steps of
/// improve_fan lead along normals and do not see a tip beside the node. False, and nothing changed,
/// where it does not.
bool reach_for_outlier(const RefinementState& state, FanWorkspace& work, const FanLimits& limits);

}  // namespace wscvt
