// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

/// Bodies that no ray from one centre describes, and their scans: what shells, hooks and grains
/// with undercuts are like.
/// Bodies with handles, made as a scanner makes them: voxels and their surface.
namespace wscvt::test {

/// A body of genus 0 about the origin: where `depth` is above 0, in the box between `low` and
/// `high`. Depths are lengths near the surface.
struct BentGrain {
  std::string name;
  Vector3 low = Vector3::Zero();
  Vector3 high = Vector3::Zero();
  std::function<double(const Vector3&)> depth;
};

/// Crescent, bowl (a thin shell), C-shape, hook, mushroom, aggregate of ten balls, flake, rod
/// 16 : 1. About two units across.
std::vector<BentGrain> bent_grains();

/// The one of that name.
BentGrain bent_grain(const std::string& name);

/// Its scan of about so many vertices (to about three per cent): voxels inside or outside, after a
/// roughness of rms 0.008, blurred, and the surface of half of full density. Closed, of genus 0.
IndexedMesh bent_grain_mesh(const BentGrain& grain, int vertices);

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
