// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "toolbox/volume/voxel_surface.h"
#include "wscvt/base/counting_sort.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge_of(const VoxelFace& face, std::size_t k) {
  return std::minmax(face[k], face[(k + 1) % 4]);
}

/// Returns the neighbours of every vertex along edges of faces. Each edge is in two faces, once in
/// either direction.
Groups neighbours_of(const VoxelSurface& surface) {
  Groups groups = counting_sort(4 * surface.faces.size(), surface.corners.size(),
                                [&](std::size_t half_edge, const auto& visit) {
                                  visit(index(surface.faces[half_edge / 4][half_edge % 4]));
                                });
  for (std::int32_t& item : groups.items) {
    item = surface.faces[index(item) / 4][(index(item) + 1) % 4];
  }
  return groups;
}

/// Returns edges that share both their vertices with another edge.
std::set<Edge> doubled_edges(const Groups& neighbours) {
  std::set<Edge> doubled;
  std::vector<std::int32_t> sorted;
  for (std::size_t v = 0; v + 1 < neighbours.starts.size(); ++v) {
    const auto begin = neighbours.items.begin();
    sorted.assign(begin + static_cast<std::ptrdiff_t>(neighbours.starts[v]),
                  begin + static_cast<std::ptrdiff_t>(neighbours.starts[v + 1]));
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 1; k < sorted.size(); ++k) {
      if (sorted[k] == sorted[k - 1]) {
        doubled.insert(std::minmax(static_cast<std::int32_t>(v), sorted[k]));
      }
    }
  }
  return doubled;
}

/// Diffusion along the lattice's edges. It stores each vertex's displacement from its corner of the
/// lattice, at most half a voxel. Single precision keeps a ten-millionth of it, and takes a third
/// of the time of positions in double precision.
class Diffusion {
 public:
  Diffusion(const std::vector<VoxelCounts>& corners, const Groups& neighbours)
      : neighbours_(neighbours),
        away_(corners.size(), Four::Zero()),
        moved_(corners.size()),
        mean_(corners.size()) {
    for (std::size_t v = 0; v < corners.size(); ++v) {
      VoxelCounts sum{};
      for (std::size_t k = neighbours.starts[v]; k < neighbours.starts[v + 1]; ++k) {
        const VoxelCounts& other = corners[index(neighbours.items[k])];
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += other[axis] - corners[v][axis];
      }
      const float share =
          1.0F / static_cast<float>(neighbours.starts[v + 1] - neighbours.starts[v]);
      mean_[v] = Four(static_cast<float>(sum[0]), static_cast<float>(sum[1]),
                      static_cast<float>(sum[2]), 1.0F) *
                 share;
    }
  }

  /// Makes one step and keeps the vertices in their cells.
  void run(float step) {
    const Four half_a_voxel = Four::Constant(0.5F);
    for (std::size_t v = 0; v < away_.size(); ++v) {
      Four sum = Four::Zero();
      for (std::size_t k = neighbours_.starts[v]; k < neighbours_.starts[v + 1]; ++k) {
        sum += away_[index(neighbours_.items[k])];
      }
      const Four to_mean = sum * mean_[v][3] + mean_[v] - away_[v];
      moved_[v] = (away_[v] + step * to_mean).max(-half_a_voxel).min(half_a_voxel);
    }
    away_.swap(moved_);
  }

  /// Returns the displacement of a vertex from its corner.
  Vector3 away(std::size_t vertex) const { return away_[vertex].head<3>().cast<double>(); }

 private:
  using Four = Eigen::Array4f;  ///< three coordinates; processors have no operations for three

  const Groups& neighbours_;
  std::vector<Four> away_;
  std::vector<Four> moved_;
  /// mean of the neighbours' corners relative to the own; last: 1 / their number
  std::vector<Four> mean_;
};

/// Returns the voxel inside a face: twice its middle, in whole numbers.
std::tuple<int, int, int> voxel_inside(const VoxelSurface& surface, const VoxelFace& face) {
  std::array<VoxelCounts, 4> corners{};
  for (std::size_t k = 0; k < 4; ++k) corners[k] = surface.corners[index(face[k])];
  VoxelCounts middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    const std::int32_t normal = (corners[1][b] - corners[0][b]) * (corners[3][c] - corners[0][c]) -
                                (corners[1][c] - corners[0][c]) * (corners[3][b] - corners[0][b]);
    middle[axis] = corners[0][axis] + corners[2][axis] - normal;
  }
  return {middle[0], middle[1], middle[2]};
}

/// Splits faces into triangles.
class FaceSplitter {
 public:
  FaceSplitter(const VoxelSurface& surface, const std::set<Edge>& doubled, IndexedMesh& mesh)
      : surface_(surface), doubled_(doubled), mesh_(mesh) {}

  void run() {
    mesh_.triangles.reserve(2 * surface_.faces.size());
    if (!doubled_.empty()) add_middles();
    std::vector<std::int32_t> round;
    for (const VoxelFace& face : surface_.faces) {
      std::size_t first_middle = 4;
      round.clear();
      for (std::size_t k = 0; k < 4; ++k) {
        round.push_back(face[k]);
        if (doubled_.empty() || doubled_.count(edge_of(face, k)) == 0) continue;
        if (first_middle == 4) first_middle = round.size();
        round.push_back(middles_.at({edge_of(face, k), voxel_inside(surface_, face)}));
      }
      if (round.size() > 4) {
        // A fan about a middle: its inner edges are in no other face's triangles.
        std::rotate(round.begin(), round.begin() + static_cast<std::ptrdiff_t>(first_middle),
                    round.end());
      } else if (is_longer(face[0], face[2], face[1], face[3])) {
        std::rotate(round.begin(), round.begin() + 1, round.end());
      }
      for (std::size_t k = 2; k < round.size(); ++k) {
        mesh_.triangles.push_back({round[0], round[k - 1], round[k]});
      }
    }
  }

 private:
  bool is_longer(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    return (mesh_.points[index(a)] - mesh_.points[index(b)]).squaredNorm() >
           (mesh_.points[index(c)] - mesh_.points[index(d)]).squaredNorm();
  }

  /// Adds the middles of doubled edges, moved to each edge's own two faces and away from the other
  /// edge.
  void add_middles() {
    for (const VoxelFace& face : surface_.faces) {
      for (std::size_t k = 0; k < 4; ++k) {
        const Edge edge = edge_of(face, k);
        if (doubled_.count(edge) == 0) continue;
        const auto [place, is_new] =
            middles_.emplace(std::pair(edge, voxel_inside(surface_, face)),
                             static_cast<std::int32_t>(mesh_.points.size()));
        if (is_new) mesh_.points.emplace_back(Vector3::Zero());
        // Both faces add an eighth of each of their vertices; the edge's two vertices are in both.
        Vector3& middle = mesh_.points[index(place->second)];
        for (const std::int32_t vertex : face) middle += mesh_.points[index(vertex)] / 8.0;
      }
    }
  }

  const VoxelSurface& surface_;
  const std::set<Edge>& doubled_;
  IndexedMesh& mesh_;
  std::map<std::pair<Edge, std::tuple<int, int, int>>, std::int32_t> middles_;
};

/// Scales the mesh about its centroid to a volume.
void restore_volume(IndexedMesh& mesh, double volume) {
  // About a vertex, because cones from a distant point lose digits.
  const Vector3 start = mesh.points.front();
  const MeshSums sums = mesh_sums(mesh.points, mesh.triangles, start, Execution(1));
  constexpr double least_share = 0.1;
  if (!(sums.volume() > least_share * volume)) {
    throw Error(ErrorCode::NumericalFailure,
                "Smoothing leaves less than a tenth of the grain's volume: it is a voxel or two "
                "thick. Give fewer passes by " +
                    mention("smoothing") + ".");
  }
  const Vector3 centroid = start + sums.centroid();
  const double scale = portable::cbrt(volume / sums.volume());
  for (Vector3& point : mesh.points) point = centroid + scale * (point - centroid);
}

}  // namespace

IndexedMesh smoothed_surface(const VoxelSurface& surface, int passes,
                             const VolumeGeometry& geometry) {
  // Taubin's pass band of 0.1, as 1 / step + 1 / back = 0.1: slower variations stay.
  constexpr float step = 0.6307F;
  constexpr float back = -0.6732F;
  const Groups neighbours = neighbours_of(surface);
  Diffusion diffusion(surface.corners, neighbours);
  for (int pass = 0; pass < passes; ++pass) {
    diffusion.run(step);
    diffusion.run(back);
  }
  IndexedMesh mesh;
  mesh.points.reserve(surface.corners.size());
  for (std::size_t v = 0; v < surface.corners.size(); ++v) {
    const VoxelCounts& corner = surface.corners[v];
    mesh.points.push_back(Vector3(corner[0], corner[1], corner[2]) + diffusion.away(v));
  }
  const std::set<Edge> doubled = doubled_edges(neighbours);
  FaceSplitter(surface, doubled, mesh).run();
  restore_volume(mesh, static_cast<double>(surface.enclosed));
  for (Vector3& point : mesh.points) point = geometry.point(point);
  if (geometry.axes.determinant() < 0.0) {  // left-handed axes turn the faces inside out
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

}  // namespace wscvt
