// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/conforming_grains.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "toolbox/conforming/wall_remesh.h"
#include "toolbox/conforming/wall_repair.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/base/counting_sort.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// A grain gets shorter edges if the cube of its volume has fewer of them along a side. A ball has
/// then about 22 nodes.
constexpr double edges_across = 2.0;

constexpr std::int64_t fewest_voxels = 64;  ///< a cube of 4; smoothing halves smaller ones

/// Returns the longest edge of a voxel.
double longest_voxel_edge(const VolumeGeometry& geometry) {
  return geometry.axes.colwise().norm().maxCoeff();
}

void count_nodes(ConformingGrains& result) {
  std::vector<std::int32_t> last(result.grains.size(), -1);
  const Groups at = counting_sort(result.triangles.size(), result.points.size(),
                                  [&](std::size_t t, const auto& visit) {
                                    for (const std::int32_t corner : result.triangles[t].corners)
                                      visit(index(corner));
                                  });
  for (std::size_t v = 0; v < result.points.size(); ++v) {
    for (const std::int32_t* t = at.begin(v); t != at.end(v); ++t) {
      const WallTriangle& triangle = result.triangles[index(*t)];
      for (const std::int32_t grain : {triangle.inner, triangle.outer}) {
        if (grain < 0 || last[index(grain)] == static_cast<std::int32_t>(v)) continue;
        last[index(grain)] = static_cast<std::int32_t>(v);
        ++result.grains[index(grain)].nodes;
      }
    }
  }
}

void measure_walls(ConformingGrains& result) {
  std::map<std::pair<std::int32_t, std::int32_t>, ConformingWall> walls;
  for (const WallTriangle& t : result.triangles) {
    ++result.grains[index(t.inner)].triangles;
    if (t.outer < 0) continue;
    ++result.grains[index(t.outer)].triangles;
    const Vector3& a = result.points[index(t.corners[0])];
    const Vector3& b = result.points[index(t.corners[1])];
    const Vector3& c = result.points[index(t.corners[2])];
    ConformingWall& wall = walls[{t.outer, t.inner}];
    wall.first = t.outer;
    wall.second = t.inner;
    ++wall.triangles;
    const Vector3 normal = doubled_area_normal(a, b, c);
    const double area = 0.5 * normal.norm();
    wall.area += area;
    wall.centre += area / 3.0 * (a + b + c);
    wall.normal -= normal;  // triangles are seen from `outer`, the first
  }
  for (auto& [grains, wall] : walls) {
    if (wall.area > 0.0) wall.centre /= wall.area;
    wall.normal.normalize();
    ++result.grains[index(wall.first)].contacts;
    ++result.grains[index(wall.second)].contacts;
    result.walls.push_back(wall);
  }
}

void measure_edges(ConformingGrains& result) {
  // Each edge as often as it is in triangles.
  double sum = 0.0;
  double squares = 0.0;
  for (const WallTriangle& t : result.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double square =
          (result.points[index(t.corners[k])] - result.points[index(t.corners[following(k)])])
              .squaredNorm();
      sum += std::sqrt(square);
      squares += square;
    }
  }
  const auto count = 3.0 * static_cast<double>(result.triangles.size());
  result.mean_edge = sum / count;
  result.edge_variation =
      std::sqrt(std::max(0.0, squares / count - result.mean_edge * result.mean_edge)) /
      result.mean_edge;
}

/// Returns the closed mesh of a grain. `by_grain`: the triangles of each.
IndexedMesh mesh_of(const ConformingGrains& grains, const Groups& by_grain, std::size_t grain) {
  IndexedMesh mesh;
  std::vector<std::int32_t> used;
  for (const std::int32_t* at = by_grain.begin(grain); at != by_grain.end(grain); ++at) {
    const WallTriangle& t = grains.triangles[index(*at)];
    Triangle corners = t.corners;
    if (index(t.inner) != grain) std::swap(corners[1], corners[2]);
    mesh.triangles.push_back(corners);
    used.insert(used.end(), corners.begin(), corners.end());
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::int32_t v : used) mesh.points.push_back(grains.points[index(v)]);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& corner : t) {
      corner = static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), corner) -
                                         used.begin());
    }
  }
  return mesh;
}

/// Makes all grains well-composed and of one piece. Returns the number of changed voxels.
std::size_t compose(GrainVoxels& voxels, std::size_t grains) {
  constexpr int most_rounds = 10;
  std::size_t changed = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t now = make_well_composed(voxels);
    if (now == 0) return changed;
    changed += now;
    keep_largest_pieces(voxels, grains);
  }
  throw Error(ErrorCode::NumericalFailure,
              "The grains fall into pieces again and again when they are made well-composed. "
              "Segment the volume with less noise.");
}

}  // namespace

void check_conforming_options(const ConformingOptions& options) {
  require_in_range(options.edge_length, edge_length_option);
  require_in_range(options.nodes, wall_nodes_option);
  if (options.edge_length > 0.0 && options.nodes > 0) {
    refuse("Give " + mention(edge_length_option) + " or " + mention(wall_nodes_option) +
           ", not both.");
  }
}

ConformingGrains conform_grains(GrainVoxels voxels, std::size_t grains,
                                const VolumeGeometry& geometry, const ConformingOptions& options,
                                const Execution& execution) {
  check_conforming_options(options);
  if (grains == 0) refuse("There is no grain to remesh.");
  const double voxel = longest_voxel_edge(geometry);
  const double edge = options.edge_length > 0.0 ? options.edge_length : 3.0 * voxel;
  if (edge < voxel) {
    refuse("The edge length " + format_number(edge) + " is below a voxel's edge, " +
           format_number(voxel) + ". Give a larger one by " + mention(edge_length_option) + ".");
  }
  execution.report(0.0, "Finding the pieces of the grains");
  const std::vector<GrainPieces> pieces = keep_largest_pieces(voxels, grains);
  remove_thin_parts(voxels);
  const std::vector<GrainPieces> cleaned = keep_largest_pieces(voxels, grains);
  ConformingGrains result;
  result.grains.resize(grains);
  std::vector<double> volumes(grains);
  for (std::size_t g = 0; g < grains; ++g) {
    if (pieces[g].voxels == 0) refuse("Grain " + std::to_string(g) + " has no voxel.");
    ConformingGrain& grain = result.grains[g];
    grain.voxels = cleaned[g].voxels;
    if (grain.voxels < fewest_voxels) {
      refuse("A grain has only " + std::to_string(grain.voxels) +
             " voxels. Its wall cannot be smoothed. Leave out grains of less than " +
             std::to_string(fewest_voxels) + " voxels by " + mention(smallest_option) + ".");
    }
    grain.gained = cleaned[g].voxels - pieces[g].voxels;
    grain.pieces = pieces[g].pieces;
    grain.left_out = pieces[g].left_out;
    grain.pore_voxels = pieces[g].pore_voxels;
    volumes[g] = static_cast<double>(grain.voxels) * geometry.voxel_volume();
    grain.voxel_volume = volumes[g];
    result.gained_voxels += grain.gained;
  }
  result.changed_voxels = compose(voxels, grains);
  execution.report(0.1, "Finding the walls");
  VoxelWalls walls = voxel_walls(voxels);
  voxels = GrainVoxels({0, 0, 0});
  const DenseWalls dense(std::move(walls), options.smoothing, geometry, execution.part(0.15, 0.4));
  std::vector<double> edges;
  for (const double volume : volumes) {
    edges.push_back(std::min(edge, portable::cbrt(volume) / edges_across));
  }
  WallRemesher remesher(dense, std::move(edges));
  remesher.run(voxel, options.nodes, execution.part(0.4, 0.85));
  const FinishedWalls finished =
      finish_walls(remesher.mesh(), volumes, voxel, execution.part(0.85, 1.0));
  result.points = std::move(remesher.mesh().points);
  result.triangles = std::move(remesher.mesh().triangles);
  result.intersections = finished.pairs.size();
  for (const auto& [a, b] : finished.pairs) {
    for (const std::int32_t t : {a, b}) {
      const WallTriangle& triangle = result.triangles[index(t)];
      for (const std::int32_t grain : {triangle.inner, triangle.outer}) {
        if (grain >= 0) result.grains[index(grain)].intersects = true;
      }
    }
  }
  result.volume_error = finished.volume_error;
  const std::vector<double> got = wall_volumes(result.points, result.triangles, grains);
  for (std::size_t g = 0; g < grains; ++g) result.grains[g].volume = got[g];
  count_nodes(result);
  measure_walls(result);
  measure_edges(result);
  return result;
}

std::vector<IndexedMesh> grain_meshes(const ConformingGrains& grains) {
  const Groups by_grain = counting_sort(grains.triangles.size(), grains.grains.size(),
                                        [&](std::size_t t, const auto& visit) {
                                          const WallTriangle& triangle = grains.triangles[t];
                                          visit(index(triangle.inner));
                                          if (triangle.outer >= 0) visit(index(triangle.outer));
                                        });
  std::vector<IndexedMesh> meshes;
  for (std::size_t grain = 0; grain < grains.grains.size(); ++grain) {
    meshes.push_back(mesh_of(grains, by_grain, grain));
  }
  return meshes;
}

}  // namespace wscvt
