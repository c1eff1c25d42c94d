// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "toolbox/conforming/grain_voxels.h"
#include "toolbox/fragment/common_walls.h"
#include "wscvt/base/counting_sort.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A face of voxels between two grains, or a grain and the background: four vertices,
/// counter-clockwise seen from `outer`.
struct WallQuad {
  std::array<std::int32_t, 4> corners;
  std::int32_t inner;  ///< the larger grain
  std::int32_t outer;  ///< the smaller grain; -1: background
};

/// The faces between all grains, with common vertices.
struct VoxelWalls {
  std::vector<VoxelCounts> corners;  ///< of the lattice, at the vertices
  std::vector<WallQuad> quads;
};

/// Makes the walls. Grains that touch only in an edge or a corner, with background between them,
/// are apart: each has its own vertices there. If the grains are well-composed, each of them is
/// closed and manifold.
VoxelWalls voxel_walls(const GrainVoxels& voxels);

/// The place of a vertex among the walls.
enum class WallPlace : std::uint8_t {
  Wall,   ///< within a wall
  Line,   ///< on a line where walls meet
  Point,  ///< where lines meet or end
};

/// A place on the dense walls.
struct WallPoint {
  Vector3 point = Vector3::Zero();
  std::int32_t vertex = -1;  ///< near it
};

/// Walls of small triangles. New nodes are placed on them.
class DenseWalls {
 public:
  explicit DenseWalls(WallComplex walls);

  /// Smooths the faces of voxels as smoothed_surface does, each kind of place for itself: walls
  /// within their surface, lines along themselves.
  DenseWalls(VoxelWalls walls, int passes, const VolumeGeometry& geometry,
             const Execution& execution);

  const WallComplex& walls() const { return walls_; }
  const std::vector<WallPlace>& places() const { return places_; }
  /// Of the vertices within walls, towards `outer`; length 1.
  const std::vector<Eigen::Vector3f>& normals() const { return normals_; }

  /// Returns a place of the wall between two grains near `target`: goes from vertex to vertex
  /// towards it, from a vertex of the wall on.
  WallPoint nearest_on_wall(std::int32_t from, const Vector3& target, std::int32_t inner,
                            std::int32_t outer) const;

  /// Returns a place of the line of a vertex that is on a line near `target`, as above.
  WallPoint nearest_on_line(std::int32_t from, const Vector3& target) const;

 private:
  template <class Face>
  void find_places(const std::vector<Face>& faces, const Groups& faces_at);
  void find_normals();
  bool is_on_short_loop(std::size_t v) const;
  void smooth(const VoxelWalls& walls, const Groups& quads_at, int passes,
              const Execution& execution);

  WallComplex walls_;
  Groups triangles_at_;  ///< each vertex
  std::vector<WallPlace> places_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<std::int32_t> line_of_;                       ///< row of line_neighbours_, or -1
  std::vector<std::vector<std::int32_t>> line_neighbours_;  ///< along lines, of lines and points
};

/// Moves vertices so that every grain has its volume: along the walls' normals, all vertices of a
/// grain's side by the same length times the vertex' share, above 0 (least squares, weighted by
/// area). Returns the largest difference that is left, relative.
double restore_volumes(WallComplex& walls, const std::vector<double>& volumes,
                       const std::vector<double>& shares);

/// Returns the volume of each grain.
std::vector<double> wall_volumes(const WallComplex& walls, std::size_t grains);

}  // namespace wscvt
