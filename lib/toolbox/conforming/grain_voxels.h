// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "toolbox/volume/label_volume.h"

namespace wscvt {

/// The voxels of a volume, each with its grain. The outermost voxels are background.
struct GrainVoxels {
  VoxelCounts counts = {};
  std::vector<std::int32_t> grain;  ///< x fastest, then y; -1: background

  /// Makes a volume of background.
  explicit GrainVoxels(const VoxelCounts& size);

  std::size_t place(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(counts[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(counts[0]) +
           static_cast<std::size_t>(x);
  }
  /// Distance of two voxels' places along each axis.
  std::array<std::size_t, 3> steps() const { return {1, place(0, 1, 0), place(0, 0, 1)}; }
};

/// What keep_largest_pieces found in a grain.
struct GrainPieces {
  std::size_t pieces = 0;        ///< connected by faces of voxels
  std::int64_t voxels = 0;       ///< of the largest piece, pores filled
  std::int64_t left_out = 0;     ///< voxels of the other pieces
  std::int64_t pore_voxels = 0;  ///< that were filled
};

/// Makes background of all pieces of a grain but the largest, and fills the pores that a single
/// grain encloses. Returns a row per grain.
std::vector<GrainPieces> keep_largest_pieces(GrainVoxels& voxels, std::size_t grains);

/// Removes parts that are one voxel thick between grains: gaps between two grains, notches, and
/// thin ends of a grain between others. A voxel that differs from the grains before and behind it
/// along an axis goes to the one with more voxels about it, of equal ones to the first. Up to ten
/// passes.
void remove_thin_parts(GrainVoxels& voxels);

/// Changes voxels until every grain is well-composed: where two of its voxels touch in an edge or a
/// corner, a chain of faces connects them there, and the same holds for what is outside it. Then
/// the boundary of every grain is a closed manifold (Latecki 1997, 3D well-composed pictures).
/// Returns the number of changed voxels. Throws Error(NumericalFailure) if it does not succeed.
std::size_t make_well_composed(GrainVoxels& voxels);

}  // namespace wscvt
