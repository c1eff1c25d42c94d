// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "wscvt/base/indexed_mesh.h"

/// Bodies with handles, made as a scanner makes them: voxels and their surface.
namespace wscvt::test {

/// The surface of a body given by its depth below the surface, on voxels of 0.04, in a box of -1.5
/// to 1.5. Closed.
IndexedMesh body_of_depth(const std::function<double(const Vector3&)>& depth);

/// Depths: of the unit ball; of half a ring that stands out of it as the handle of a cup does; of
/// the ball with a hole drilled through it near its edge.
double ball(const Vector3& p);
double bridge(const Vector3& p);
double drilled(const Vector3& p);

/// Both of genus 1.
IndexedMesh ball_with_a_bridge();
IndexedMesh ball_with_a_tunnel();

}  // namespace wscvt::test
