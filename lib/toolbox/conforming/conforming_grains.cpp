// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/conforming_grains.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "toolbox/conforming/wall_remesh.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/base/counting_sort.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/self_intersections.h"

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

IndexedMesh all_triangles(const std::vector<Vector3>& points,
                          const std::vector<WallTriangle>& triangles) {
  IndexedMesh mesh;
  mesh.points = points;
  mesh.triangles.reserve(triangles.size());
  for (const WallTriangle& t : triangles) mesh.triangles.push_back(t.corners);
  return mesh;
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

/// Moves the nodes of intersecting triangles: sheets of free surface away from each other, by
/// `step`, others to the middle of their neighbours.
void part_pairs(WallMesh& mesh, const std::vector<TrianglePair>& pairs, double step) {
  std::vector<Vector3> shift(mesh.points.size(), Vector3::Zero());
  std::vector<char> is_knot(mesh.points.size(), 0);
  for (const auto& [first, second] : pairs) {
    const WallTriangle& a = mesh.triangles[index(first)];
    const WallTriangle& b = mesh.triangles[index(second)];
    const bool are_free = a.outer < 0 && b.outer < 0;
    const bool touch = std::any_of(a.corners.begin(), a.corners.end(), [&](std::int32_t corner) {
      return std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end();
    });
    for (const WallTriangle* t : {&a, &b}) {
      const Vector3 normal =
          doubled_area_normal(mesh.points[index(t->corners[0])], mesh.points[index(t->corners[1])],
                              mesh.points[index(t->corners[2])])
              .normalized();
      for (const std::int32_t corner : t->corners) {
        if (are_free && !touch) {
          shift[index(corner)] += a.inner == b.inner ? normal : Vector3(-normal);
        } else {
          is_knot[index(corner)] = 1;
        }
      }
    }
  }
  const std::vector<Vector3> before = mesh.points;
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (is_knot[v] != 0) {
      Vector3 sum = Vector3::Zero();
      double count = 0.0;
      const auto add = [&](std::int32_t other) {
        sum += before[index(other)];
        count += 1.0;
      };
      if (mesh.places[v] == WallPlace::Line) {
        for (const std::int32_t end : mesh.line_neighbours(static_cast<std::int32_t>(v))) add(end);
      } else {
        mesh.visit_triangles(static_cast<std::int32_t>(v), [&](std::size_t t) {
          for (const std::int32_t corner : mesh.triangles[t].corners) {
            if (index(corner) != v) add(corner);
          }
        });
      }
      if (count > 0.0) mesh.points[v] += 0.5 * (sum / count - before[v]);
    } else if (shift[v].squaredNorm() > 0.0) {
      mesh.points[v] += step * shift[v].normalized();
    }
  }
}

/// Restores the volumes and parts intersecting triangles, until none is left or there are no fewer.
void finish(WallMesh& mesh, const std::vector<double>& volumes, double voxel,
            ConformingGrains& result, const Execution& execution) {
  constexpr int most_rounds = 30;
  constexpr int patience = 5;   // rounds without fewer pairs; a volume of 400^3 takes 15 s a round
  constexpr double step = 0.1;  // of a voxel; wide against rounding, small against a gap
  result.triangles = mesh.triangles;
  int since = 0;
  for (int round = 0; round <= most_rounds && since <= patience; ++round, ++since) {
    execution.report(static_cast<double>(round) / (most_rounds + 1), "Parting triangles");
    const double error = restore_volumes(mesh.points, mesh.triangles, volumes);
    const std::vector<TrianglePair> pairs =
        self_intersections(all_triangles(mesh.points, mesh.triangles), execution.part(0.0, 0.0));
    if (round == 0 || pairs.size() < result.intersections) {
      result.points = mesh.points;
      result.intersections = pairs.size();
      result.volume_error = error;
      since = 0;
    }
    if (pairs.empty()) return;
    part_pairs(mesh, pairs, step * voxel);
  }
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

}  // namespace

ConformingGrains conform_grains(GrainVoxels voxels, std::size_t grains,
                                const VolumeGeometry& geometry, const ConformingOptions& options,
                                const Execution& execution) {
  require_in_range(options.edge_length, edge_length_option);
  if (grains == 0) refuse("There is no grain to remesh.");
  const double voxel = longest_voxel_edge(geometry);
  const double edge = options.edge_length > 0.0 ? options.edge_length : 3.0 * voxel;
  if (edge < voxel) {
    refuse("The edge length " + format_number(edge) + " is below a voxel's edge, " +
           format_number(voxel) + ". Give a larger one by " + mention(edge_length_option) + ".");
  }
  execution.report(0.0, "Finding the pieces of the grains");
  const std::vector<GrainPieces> pieces = keep_largest_pieces(voxels, grains);
  ConformingGrains result;
  result.grains.resize(grains);
  std::vector<double> volumes(grains);
  for (std::size_t g = 0; g < grains; ++g) {
    if (pieces[g].voxels == 0) refuse("Grain " + std::to_string(g) + " has no voxel.");
    if (pieces[g].voxels < fewest_voxels) {
      refuse("A grain has only " + std::to_string(pieces[g].voxels) +
             " voxels. Its wall cannot be smoothed. Leave out grains of less than " +
             std::to_string(fewest_voxels) + " voxels by " + mention(smallest_option) + ".");
    }
    ConformingGrain& grain = result.grains[g];
    grain.voxels = pieces[g].voxels;
    grain.pieces = pieces[g].pieces;
    grain.left_out = pieces[g].left_out;
    grain.pore_voxels = pieces[g].pore_voxels;
    grain.voxel_volume = static_cast<double>(pieces[g].voxels) * geometry.voxel_volume();
    volumes[g] = grain.voxel_volume;
  }
  result.changed_voxels = make_well_composed(voxels);
  if (result.changed_voxels > 0) keep_largest_pieces(voxels, grains);
  execution.report(0.1, "Finding the walls");
  VoxelWalls walls = voxel_walls(voxels);
  voxels = GrainVoxels({0, 0, 0});
  const DenseWalls dense(std::move(walls), options.smoothing, geometry, volumes,
                         execution.part(0.15, 0.4));
  std::vector<double> edges;
  for (const double volume : volumes) {
    edges.push_back(std::min(edge, portable::cbrt(volume) / edges_across));
  }
  WallRemesher remesher(dense, std::move(edges));
  remesher.run(voxel, execution.part(0.4, 0.85));
  finish(remesher.mesh(), volumes, voxel, result, execution.part(0.85, 1.0));
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
