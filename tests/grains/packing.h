// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt::test {

/// A superellipsoid |x/a|^q + |y/b|^q + |z/c|^q <= 1, turned and moved.
struct PackedGrain {
  Vector3 centre = Vector3::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vector3 half_axes = Vector3::Ones();
  double power = 2.0;

  /// Below 1 inside, above 1 outside; grows in proportion from the centre.
  double gauge(const Vector3& point) const;
  double volume() const;  ///< by its formula
};

struct PackingOptions {
  std::size_t count = 12;
  double smallest = 6.0;  ///< half axes: the largest of the smallest grain
  double largest = 10.0;  ///< of the largest; sizes between are evenly spread, none twice
  Vector3 box = {48.0, 46.0, 60.0};
  double margin = 2.0;  ///< between grains and the sides of the box
  std::uint64_t seed = 7;
};

/// Grains that lie on each other: each comes from above, the largest first, and goes down in small
/// random moves until none is left. They touch to .05 and do not overlap by more than that. Throws
/// std::runtime_error where the box is full.
std::vector<PackedGrain> packing(const PackingOptions& options);

/// Voxels of a packing, x fastest.
struct PackedVoxels {
  std::array<int, 3> counts{};
  Vector3 spacing = Vector3::Ones();
  std::vector<double> share;         ///< of each voxel that is in grains
  std::vector<std::uint32_t> truth;  ///< the grain at its middle, from 1; 0: none
};
PackedVoxels voxels_of(const std::vector<PackedGrain>& grains, const Vector3& box,
                       const Vector3& spacing);

/// What a scanner gives: `dark` in the void, `bright` in grains, blurred by `blur` voxels (standard
/// deviation), with noise of `noise` of the contrast.
struct GreyOptions {
  double dark = 60.0;
  double bright = 160.0;
  double blur = 1.0;
  double noise = 0.05;
  std::uint64_t seed = 11;
};
std::vector<std::uint32_t> grey_values(const PackedVoxels& voxels, const GreyOptions& options);

/// How labels meet the truth.
struct PackingFound {
  std::size_t one_to_one = 0;  ///< grains of which a label holds more than half, and it of them
  double volume_bias = 0.0;    ///< of all labels against all grains' formulas
  std::size_t labels = 0;
};
PackingFound found_in(const std::vector<std::uint32_t>& labels,
                      const std::vector<PackedGrain>& grains, const PackedVoxels& voxels);

}  // namespace wscvt::test
