// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "wscvt/base/mesh.h"

/// Grains made from formulas, and their scans: what the tests and the samples are made of.
namespace wscvt::test {

/// Radii in `directions` (unit vectors).
using RadiusFunction = std::function<std::vector<double>(const std::vector<Vector3>& directions)>;

/// A star-shaped body of volume 4 pi / 3 (equal-volume radius 1).
struct Grain {
  std::string name;
  RadiusFunction radii;
};

/// Ellipsoid, half axes 1 : 0.7 : 0.5.
Grain ellipsoid_grain();

/// Superellipsoid |x/1|^q + |y/0.8|^q + |z/0.65|^q = 1, q = 5: a rounded box.
Grain superellipsoid_grain();

/// Sand: a smoothed polyhedron of 16 faces times (1 + harmonics of degree 2 to 15, rms 0.045).
Grain sand_grain(std::uint64_t seed);

/// The same polyhedron with fine roughness too, times (1 + harmonics of degree 2 to 60, rms 0.047),
/// whose amplitude falls with 1 / degree: scanned, a spectrum near that of scans of real sand.
Grain textured_sand_grain(std::uint64_t seed);

/// Rough: ellipsoid 2 : 1 : 1 times (1 + harmonics of degree 3 to 30, rms 0.045).
Grain rough_grain(std::uint64_t seed);

/// Crushed: a polyhedron of 13 faces with sharp edges, lightly roughened.
Grain angular_grain(std::uint64_t seed);

/// The same polyhedron with fine roughness, times (1 + harmonics of degree 4 to 60, rms 0.022).
Grain textured_angular_grain(std::uint64_t seed);

/// The four grains that limits are known for: ellipsoid, superellipsoid, sand, rough.
std::vector<Grain> reference_grains();

/// A scanner: share of each voxel inside (from `supersampling`^3 points), blurred by the point
/// spread, with noise, smoothed, and the surface of half of full density.
struct CtOptions {
  double voxel = 0.062;                         ///< edge length, in equal-volume radii
  std::array<double, 3> offset{0.0, 0.0, 0.0};  ///< of the voxel grid, in voxels
  int supersampling = 3;
  double blur = 0.7;       ///< standard deviation, in voxels
  double noise = 0.03;     ///< standard deviation, of full density 1
  double smoothing = 0.5;  ///< standard deviation, in voxels
  std::uint64_t seed = 3;
};

/// Closed 2-manifold of genus 0 or more, in the grain's coordinates. The number of vertices goes
/// with 1 / voxel^2, about 7000 at 0.062 for a grain of area 13.5.
IndexedMesh ct_mesh(const Grain& grain, const CtOptions& options);

/// The same at a voxel size that brings it near a number of vertices (to about two per cent).
IndexedMesh ct_mesh_of_about(const Grain& grain, int vertices);

/// The grain itself on the vertices of a sphere mesh.
IndexedMesh exact_mesh(const Grain& grain, const IndexedMesh& sphere);

}  // namespace wscvt::test
