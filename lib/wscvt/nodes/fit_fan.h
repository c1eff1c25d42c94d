// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// The triangles about one node, whatever the mesh has there now, with the samples that they would
/// hold: to ask what the node costs at a place, and to find a better one.
struct FitFan {
  std::int32_t node = -1;  ///< of the mesh; -1 where it has none there yet
  Vector3 centre = Vector3::Zero();
  std::vector<Vector3> ring;          ///< corners about, counter-clockwise
  std::vector<std::int32_t> nodes;    ///< which nodes of the mesh they are
  std::vector<std::int32_t> samples;  ///< in the triangles of the fan
  std::vector<std::int32_t> places;   ///< triangle of each sample as of the last look, or -1
  double rest = 0.0;                  ///< length of the spokes
  double spring = 0.0;                ///< their stiffness
  double pull = 0.0;                  ///< of the node towards the middle of the ring
};

/// The step that a fan's equations want, before it is solved for.
struct FanEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vector3 right = Vector3::Zero();
  /// Damped, and at most `most` long.
  Vector3 step(double most) const;
};

/// What the fan costs with its node at `at`: errors of samples, small angles, springs; optionally
/// the equations of a step from there.
double fan_energy(const FitState& state, FitFan& fan, const Vector3& at,
                  FanEquations* equations = nullptr);

/// Whether every triangle of the fan looks as its samples do, or as those about its corners
/// (`about`, of FitState::node_normals) where it has few, keeps the angle of the round, and the
/// node has a sample near.
bool fan_is_fine(const FitState& state, FitFan& fan, const Vector3& at,
                 const std::vector<Vector3>& about);

/// The sharpest triangle of the fan with its node at `at`, as a cosine.
double fan_sharpness(const FitFan& fan, const Vector3& at);

/// The fan of a node as the mesh has it.
FitFan fan_of(const FitState& state, std::int32_t v, const NodeRing& ring);

}  // namespace wscvt
