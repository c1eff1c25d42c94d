// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/voxel_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "support/expect_error.h"
#include "support/made_volume.h"
#include "wscvt/base/mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

using test::MadeVolume;

std::vector<VoxelStretch> stretches_of(MadeVolume& volume) {
  std::vector<VoxelStretch> stretches;
  for (int z = 0; z < volume.counts[2]; ++z) {
    for (int y = 0; y < volume.counts[1]; ++y) {
      for (int x = 0; x < volume.counts[0]; ++x) {
        if (volume.at(x, y, z) == 0) continue;
        int end = x + 1;
        while (end < volume.counts[0] && volume.at(end, y, z) != 0) ++end;
        stretches.push_back({z, y, x, end});
        x = end;
      }
    }
  }
  return stretches;
}

/// By flooding: the pieces of the voxels that are not 0, which hang together by faces, and the
/// voxels of the largest with its pores, which no way through faces and edges leads out of.
struct Flooded {
  std::size_t pieces = 0;
  std::vector<std::int64_t> with_pores;  ///< of each
};

template <class Is>
std::vector<char> flood(MadeVolume& volume, std::array<int, 3> from, bool by_edges, const Is& is) {
  std::vector<char> seen(volume.labels.size(), 0);
  const auto place = [&](const std::array<int, 3>& p) {
    return (static_cast<std::size_t>(p[2]) * volume.counts[1] + p[1]) * volume.counts[0] + p[0];
  };
  std::vector<std::array<int, 3>> open = {from};
  seen[place(from)] = 1;
  while (!open.empty()) {
    const auto here = open.back();
    open.pop_back();
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int far = std::abs(dx) + std::abs(dy) + std::abs(dz);
          if (far == 0 || far > (by_edges ? 2 : 1)) continue;
          const std::array<int, 3> next = {here[0] + dx, here[1] + dy, here[2] + dz};
          bool within = true;
          for (std::size_t k = 0; k < 3; ++k) {
            within = within && next[k] >= 0 && next[k] < volume.counts[k];
          }
          if (!within || seen[place(next)] != 0 || !is(next)) continue;
          seen[place(next)] = 1;
          open.push_back(next);
        }
      }
    }
  }
  return seen;
}

Flooded flooded(MadeVolume& volume) {
  Flooded result;
  std::vector<char> all(volume.labels.size(), 0);
  for (std::size_t k = 0; k < volume.labels.size(); ++k) {
    if (volume.labels[k] == 0 || all[k] != 0) continue;
    const int x = static_cast<int>(k) % volume.counts[0];
    const int y = static_cast<int>(k) / volume.counts[0] % volume.counts[1];
    const int z = static_cast<int>(k) / volume.counts[0] / volume.counts[1];
    const std::vector<char> piece = flood(
        volume, {x, y, z}, false, [&](const auto& p) { return volume.at(p[0], p[1], p[2]) != 0; });
    const std::vector<char> outside = flood(volume, {0, 0, 0}, true, [&](const auto& p) {
      return piece[(static_cast<std::size_t>(p[2]) * volume.counts[1] + p[1]) * volume.counts[0] +
                   p[0]] == 0;
    });
    for (std::size_t v = 0; v < piece.size(); ++v) all[v] = all[v] != 0 || piece[v] != 0 ? 1 : 0;
    result.with_pores.push_back(std::count(outside.begin(), outside.end(), 0));
    ++result.pieces;
  }
  return result;
}

TEST(VoxelSurface, OfOneVoxelIsACube) {
  const VoxelSurface surface = voxel_surface({{5, 4, 3, 4}});
  EXPECT_EQ(surface.corners.size(), 8U);
  EXPECT_EQ(surface.faces.size(), 6U);
  EXPECT_EQ(surface.pieces, 1U);
  EXPECT_EQ(surface.enclosed, 1);
  const ShapeDescriptors cube =
      describe_shape(smoothed_surface(surface, 0, VolumeGeometry()), Execution(1));
  EXPECT_NEAR(cube.volume, 1.0, 1e-14);
  EXPECT_NEAR(cube.area, 6.0, 1e-13);
  EXPECT_LT((cube.centroid - Vector3(3.5, 4.5, 5.5)).norm(), 1e-13);
  EXPECT_ERROR(voxel_surface({}), InvalidInput);
}

TEST(VoxelSurface, FillsPoresAndKeepsTheLargestPiece) {
  MadeVolume volume({40, 20, 20});
  volume.fill_box(1, {2, 2, 2}, {12, 12, 12});
  volume.fill_box(0, {5, 5, 5}, {8, 9, 10});
  volume.fill_box(1, {6, 6, 6}, {7, 7, 7});  // lies in the pore
  volume.fill_box(1, {20, 2, 2}, {29, 11, 11});
  const VoxelSurface surface = voxel_surface(stretches_of(volume));
  EXPECT_EQ(surface.pieces, 3U);
  EXPECT_EQ(surface.enclosed, 1000);
  EXPECT_EQ(surface.pore_voxels, 3 * 4 * 5);
  EXPECT_EQ(surface.piece_voxels, 1000 + 729 + 1);
  EXPECT_EQ(surface.faces.size(), 600U);
}

TEST(VoxelSurface, IsAManifoldWhateverTheVoxels) {
  std::mt19937 random(5);
  std::size_t with_doubled_edges = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    const int size = round < 200 ? 5 : 9;
    MadeVolume volume({size + 2, size + 2, size + 2});
    const unsigned share = 30 + 10 * static_cast<unsigned>(round % 6);  // %
    volume.fill(1, [&](const Vector3& p) {
      const bool in_rim = p.minCoeff() < 1.0 || p.maxCoeff() > size + 1.0;
      return !in_rim && random() % 100 < share;
    });
    const VoxelSurface surface = voxel_surface(stretches_of(volume));
    const Flooded truth = flooded(volume);
    EXPECT_EQ(surface.pieces, truth.pieces);
    EXPECT_EQ(surface.enclosed,
              *std::max_element(truth.with_pores.begin(), truth.with_pores.end()));
    const IndexedMesh mesh = smoothed_surface(surface, 10, VolumeGeometry());
    if (mesh.points.size() > surface.corners.size()) ++with_doubled_edges;
    // Throws where three faces meet in an edge or two fans in a vertex.
    const Mesh checked = to_mesh(mesh);
    for (const auto half_edge : checked.halfedges()) EXPECT_FALSE(half_edge.is_boundary());
    EXPECT_NEAR(describe_shape(mesh, Execution(1)).volume / static_cast<double>(surface.enclosed),
                1.0, 1e-12);
    if (HasFailure()) return;
  }
  EXPECT_GT(with_doubled_edges, 20U);
}

TEST(SmoothedSurface, OfABallIsNearlyTheBall) {
  for (const double radius : {8.0, 15.3, 20.0}) {
    SCOPED_TRACE(radius);
    const Vector3 middle(25.2, 24.7, 25.1);
    MadeVolume volume({50, 50, 50});
    volume.fill_ball(1, middle, radius);
    const VoxelSurface surface = voxel_surface(stretches_of(volume));
    const IndexedMesh mesh = smoothed_surface(surface, 20, VolumeGeometry());
    const ShapeDescriptors ball = describe_shape(mesh, Execution(1));
    EXPECT_NEAR(ball.volume / static_cast<double>(surface.enclosed), 1.0, 1e-12);
    // What lib/README.md says. Voxels' faces have half as much again.
    const double volume_radius = std::cbrt(3.0 * ball.volume / (4.0 * pi));
    const double more_area = ball.area / (4.0 * pi * volume_radius * volume_radius) - 1.0;
    EXPECT_GT(more_area, 0.0);
    EXPECT_LT(more_area, 0.0075);
    double squares = 0.0;
    for (const Vector3& p : mesh.points) {
      const double off = (p - middle).norm() - radius;
      EXPECT_LT(std::abs(off), 0.6);
      squares += off * off;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(mesh.points.size())), 0.11);
  }
}

TEST(SmoothedSurface, KeepsVerticesInTheirCellsAndThinPlatesApart) {
  MadeVolume volume({44, 44, 7});
  volume.fill_box(1, {2, 2, 3}, {42, 42, 4});
  const VoxelSurface surface = voxel_surface(stretches_of(volume));
  const IndexedMesh mesh = smoothed_surface(surface, 100, VolumeGeometry());
  // Scaled up by what the rim has lost.
  const double scale = 1.1;
  for (std::size_t v = 0; v < surface.corners.size(); ++v) {
    EXPECT_LT(std::abs(mesh.points[v].z() - surface.corners[v][2]), 0.5 * scale);
    EXPECT_EQ(mesh.points[v].z() > 3.5, surface.corners[v][2] == 4);
  }
}

// A spike is a voxel wide: without its cells smoothing draws its end by voxels into the body, which
// is so large that its volume, and with it the scale, hardly changes.
TEST(SmoothedSurface, KeepsTheEndOfASpikeInItsCell) {
  MadeVolume volume({40, 24, 24});
  volume.fill_box(1, {2, 2, 2}, {22, 22, 22});
  volume.fill_box(1, {22, 12, 12}, {36, 13, 13});
  const VoxelSurface surface = voxel_surface(stretches_of(volume));
  const IndexedMesh mesh = smoothed_surface(surface, 100, VolumeGeometry());
  double farthest = 0.0;
  for (std::size_t v = 0; v < surface.corners.size(); ++v) {
    const VoxelCounts& corner = surface.corners[v];
    const Vector3 away = mesh.points[v] - Vector3(corner[0], corner[1], corner[2]);
    farthest = std::max(farthest, away.cwiseAbs().maxCoeff());
  }
  // The scale moves the spike's end, 24 voxels from the middle, by a share of a voxel.
  EXPECT_GT(farthest, 0.49);
  EXPECT_LT(farthest, 0.8);
}

TEST(SmoothedSurface, FollowsTheAxesOfTheVolume) {
  MadeVolume volume({14, 14, 14});
  volume.fill_box(1, {2, 3, 4}, {12, 11, 9});
  VolumeGeometry geometry;
  geometry.axes << 0.0, 0.5, 0.0, 0.25, 0.0, 0.0, 0.0, 0.0, 2.0;  // of a left hand
  geometry.corner = Vector3(100.0, -50.0, 7.0);
  const IndexedMesh mesh = smoothed_surface(voxel_surface(stretches_of(volume)), 0, geometry);
  const ShapeDescriptors box = describe_shape(mesh, Execution(1));
  EXPECT_NEAR(box.volume, 400.0 * 0.25, 1e-9);  // outward, or it would be below 0
  EXPECT_LT((box.centroid - geometry.point(Vector3(7.0, 7.0, 6.5))).norm(), 1e-9);
}

}  // namespace
}  // namespace wscvt
