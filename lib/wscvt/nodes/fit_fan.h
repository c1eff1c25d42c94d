// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// The triangles about one node, in the mesh or wanted there, with the samples they would have.
/// Used to compute the node's cost at a position, and to find a better position.
struct FitFan {
  std::int32_t node = -1;  ///< of the mesh; -1 if the mesh does not have it yet
  Vector3 centre = Vector3::Zero();
  std::vector<Vector3> ring;          ///< corners around the node, counter-clockwise
  std::vector<std::int32_t> nodes;    ///< their nodes in the mesh
  std::vector<std::int32_t> samples;  ///< in the triangles of the fan
  std::vector<std::int32_t> places;   ///< triangle of each sample at the last look-up, or -1
  double rest = 0.0;                  ///< length of the spokes
  double spring = 0.0;                ///< their stiffness
  double pull = 0.0;                  ///< of the node towards the middle of the ring
};

/// The equations for a fan's step, before they are solved.
struct FanEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vector3 right = Vector3::Zero();
  /// Returns the damped step, at most `most` long.
  Vector3 step(double most) const;
};

/// Returns the fan's cost with its node at `at`: errors of samples, small angles, springs;
/// optionally with the equations of a step from there.
double fan_energy(const FitState& state, FitFan& fan, const Vector3& at,
                  FanEquations* equations = nullptr);

/// Returns whether every triangle of the fan faces as its samples do and keeps the angle of the
/// round, and the node has a sample near. A triangle with few samples is compared with the samples
/// about its corners (`about`, of FitState::node_normals).
bool fan_is_fine(const FitState& state, FitFan& fan, const Vector3& at,
                 const std::vector<Vector3>& about);

/// Returns the cosine of the fan's smallest angle with its node at `at`.
double fan_sharpness(const FitFan& fan, const Vector3& at);

/// Returns the fan of a node in the mesh.
FitFan fan_of(const FitState& state, std::int32_t v, const NodeRing& ring);

}  // namespace wscvt
