// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include "toolbox/conforming/dense_walls.h"
#include "wscvt/base/error.h"

namespace wscvt {

namespace {

/// Makes vertices and faces, a layer of the lattice after the other.
class WallMaker {
 public:
  explicit WallMaker(const GrainVoxels& voxels) : voxels_(voxels), steps_(voxels.steps()) {
    for (auto& layer : layers_) layer.assign(8 * steps_[2], -1);
  }

  VoxelWalls run() {
    for (std::int32_t z = 1; z < voxels_.counts[2]; ++z) {
      add_vertices(z);
      for (std::int32_t y = 1; y < voxels_.counts[1]; ++y) {
        for (std::int32_t x = 1; x < voxels_.counts[0]; ++x) add_faces({x, y, z});
      }
    }
    return std::move(walls_);
  }

 private:
  void add_vertices(std::int32_t z) {
    std::vector<std::int32_t>& layer = layers_[z % 2];
    for (std::int32_t y = 1; y < voxels_.counts[1]; ++y) {
      for (std::int32_t x = 1; x < voxels_.counts[0]; ++x) {
        std::array<std::int32_t, 8> block{};
        bool is_even = true;
        for (std::size_t k = 0; k < 8; ++k) {
          block[k] = voxels_.grain[voxels_.place(x - 1 + static_cast<int>(k & 1U),
                                                 y - 1 + static_cast<int>(k >> 1U & 1U),
                                                 z - 1 + static_cast<int>(k >> 2U))];
          is_even = is_even && block[k] == block[0];
        }
        if (!is_even) number(block, {x, y, z}, layer.data() + 8 * voxels_.place(x, y, 0));
      }
    }
  }

  /// Gives each group of the block's voxels of grains that faces connect a vertex.
  void number(const std::array<std::int32_t, 8>& block, const VoxelCounts& corner,
              std::int32_t* vertices) {
    std::fill(vertices, vertices + 8, -1);
    for (std::size_t start = 0; start < 8; ++start) {
      if (block[start] < 0 || vertices[start] >= 0) continue;
      if (walls_.corners.size() >= std::numeric_limits<std::int32_t>::max() / 8) {
        refuse(
            "The walls of the grains have more than 268 million nodes. Give a part of the volume.");
      }
      const auto vertex = static_cast<std::int32_t>(walls_.corners.size());
      walls_.corners.push_back(corner);
      std::array<std::size_t, 8> open{start};
      std::size_t count = 1;
      vertices[start] = vertex;
      while (count > 0) {
        const std::size_t voxel = open[--count];
        for (const std::size_t bit : {1U, 2U, 4U}) {
          const std::size_t other = voxel ^ bit;
          if (block[other] < 0 || vertices[other] >= 0) continue;
          vertices[other] = vertex;
          open[count++] = other;
        }
      }
    }
  }

  /// Adds the faces between voxel (x, y, z) - (1, 1, 1) and its next voxel along each axis.
  void add_faces(const VoxelCounts& at) {
    const VoxelCounts voxel = {at[0] - 1, at[1] - 1, at[2] - 1};
    const std::size_t place = voxels_.place(voxel[0], voxel[1], voxel[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t low = voxels_.grain[place];
      const std::int32_t high = voxels_.grain[place + steps_[axis]];
      if (low == high) continue;
      WallQuad quad{{}, std::max(low, high), std::min(low, high)};
      VoxelCounts inside = voxel;
      if (high > low) ++inside[axis];
      constexpr std::array<std::array<int, 2>, 4> round = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      for (std::size_t k = 0; k < 4; ++k) {
        VoxelCounts corner = voxel;
        ++corner[axis];
        corner[(axis + 1) % 3] += round[k][0];
        corner[(axis + 2) % 3] += round[k][1];
        std::size_t octant = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          octant |= static_cast<std::size_t>(inside[a] - corner[a] + 1) << a;
        }
        quad.corners[k] =
            layers_[corner[2] % 2][8 * voxels_.place(corner[0], corner[1], 0) + octant];
      }
      if (high > low) std::reverse(quad.corners.begin(), quad.corners.end());
      walls_.quads.push_back(quad);
    }
  }

  const GrainVoxels& voxels_;
  std::array<std::size_t, 3> steps_;
  /// vertex of each voxel about each corner of a layer, of even and odd z
  std::array<std::vector<std::int32_t>, 2> layers_;
  VoxelWalls walls_;
};

}  // namespace

VoxelWalls voxel_walls(const GrainVoxels& voxels) { return WallMaker(voxels).run(); }

}  // namespace wscvt
