// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/conforming_grains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "toolbox/conforming/wall_remesh.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/base/counting_sort.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/remesh/remesh_warnings.h"
#include "wscvt/repair/scan_advice.h"

namespace wscvt {

namespace {

/// A grain gets shorter edges if the cube of its volume has fewer of them along a side. A ball has
/// then about 22 nodes.
constexpr double edges_across = 2.0;

constexpr std::int64_t fewest_voxels = 64;  ///< a cube of 4; smoothing halves smaller ones

/// Returns the edge length for each grain, shorter for small ones.
std::vector<double> edges_below(double most, const std::vector<double>& volumes) {
  std::vector<double> edges;
  edges.reserve(volumes.size());
  for (const double volume : volumes) {
    edges.push_back(std::min(most, portable::cbrt(volume) / edges_across));
  }
  return edges;
}

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
      const WallTriangle& triangle = result.triangles[*t];
      for (const std::int32_t grain : {triangle.inner, triangle.outer}) {
        if (grain < 0 || last[grain] == static_cast<std::int32_t>(v)) continue;
        last[grain] = static_cast<std::int32_t>(v);
        ++result.grains[grain].nodes;
      }
    }
  }
}

void measure_walls(ConformingGrains& result) {
  for (const WallTriangle& t : result.triangles) {
    for (const std::int32_t grain : {t.inner, t.outer}) {
      if (grain >= 0) ++result.grains[grain].triangles;
    }
  }
  result.walls = common_walls(result);
  for (const CommonWall& wall : result.walls) {
    ++result.grains[wall.first].contacts;
    ++result.grains[wall.second].contacts;
  }
}

void measure_edges(ConformingGrains& result) {
  // Each edge as often as it is in triangles.
  double sum = 0.0;
  double squares = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double flattest = -1.0;  // cosine
  for (const WallTriangle& t : result.triangles) {
    std::array<Vector3, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = result.points[t.corners[k]];
    for (std::size_t k = 0; k < 3; ++k) {
      const double square = (x[k] - x[following(k)]).squaredNorm();
      sum += std::sqrt(square);
      squares += square;
      least = std::min(least, square);
    }
    const double cosine = largest_corner_cosine(x[0], x[1], x[2]);
    if (cosine <= flattest) continue;
    flattest = cosine;
    result.flattest = t.inner;
  }
  constexpr double degrees = 57.29577951308232;
  result.smallest_angle = degrees * portable::acos(std::min(1.0, flattest));
  result.shortest_edge = std::sqrt(least);
  const auto count = 3.0 * static_cast<double>(result.triangles.size());
  result.mean_edge = sum / count;
  result.edge_variation =
      std::sqrt(std::max(0.0, squares / count - result.mean_edge * result.mean_edge)) /
      result.mean_edge;
}

/// The grains on both sides of faces of voxels, the first below the second.
using TouchingGrains = std::set<std::pair<std::int32_t, std::int32_t>>;

TouchingGrains touching_grains(const GrainVoxels& voxels) {
  TouchingGrains touching;
  for (const std::size_t step : voxels.steps()) {
    for (std::size_t k = step; k < voxels.grain.size(); ++k) {
      const std::int32_t a = voxels.grain[k - step];
      const std::int32_t b = voxels.grain[k];
      if (a >= 0 && b >= 0 && a != b) touching.emplace(std::min(a, b), std::max(a, b));
    }
  }
  return touching;
}

/// Makes all grains well-composed and of one piece: none touches itself in an edge or corner.
/// Returns the voxels of each that fell off.
std::vector<std::int64_t> compose(GrainVoxels& voxels, std::size_t grains) {
  constexpr int most_rounds = 10;
  std::vector<std::int64_t> fallen(grains, 0);
  for (int round = 0; round < most_rounds; ++round) {
    if (make_well_composed(voxels) == 0) return fallen;
    const std::vector<GrainPieces> pieces = keep_largest_pieces(voxels, grains);
    for (std::size_t g = 0; g < grains; ++g) fallen[g] += pieces[g].left_out;
  }
  throw Error(ErrorCode::NumericalFailure,
              "The grains fall into pieces again and again when they are made well-composed. "
              "Segment the volume with less noise.");
}

/// Throws Error for grains that are too small. `own`: voxels of each label.
void require_voxels(const std::vector<ConformingGrain>& grains,
                    const std::vector<std::int64_t>& own, const std::vector<Label>& labels) {
  std::size_t first = 0;
  std::size_t count = 0;
  std::int64_t most = fewest_voxels - 1;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    if (grains[g].voxels >= fewest_voxels) continue;
    if (count++ == 0) first = g;
    most = std::max(most, own[g]);
  }
  if (count == 0) return;
  const std::string name =
      labels.empty() ? "Grain " + std::to_string(first) : "Label " + std::to_string(labels[first]);
  if (own[first] == 0) refuse(name + " has no voxel.");
  const std::string others =
      count == 1 ? "" : ", and " + format_count(count - 1, "other has", "others have") + " as few";
  refuse(name + " has only " + format_count(grains[first].voxels, "voxel") +
         " in its largest piece" + others + ". Less than " + std::to_string(fewest_voxels) +
         " have no smooth wall, and parts a voxel thick between grains count as theirs. Leave out "
         "the small labels by " +
         mention(smallest_option, most + 1) + ".");
}

/// Remeshes dense walls. `edges`: wanted of each grain; `least`: see WallRemesher; `dense_edge`:
/// see finish_walls. Fills in all but what is of voxels.
void remesh_walls(const DenseWalls& dense, const std::vector<double>& volumes,
                  std::vector<double> edges, const std::vector<double>& least, int nodes,
                  bool drops_walls, ConformingGrains& result, const Execution& execution) {
  WallRemesher remesher(dense, std::move(edges));
  remesher.mesh().drops_walls = drops_walls;
  remesher.run(least, nodes, execution.part(0.0, 0.75));
  const FinishedWalls finished =
      finish_walls(remesher.mesh(), volumes, *std::min_element(least.begin(), least.end()),
                   execution.part(0.75, 1.0));
  static_cast<WallComplex&>(result) = std::move(remesher.mesh());
  result.intersections = finished.pairs.size();
  for (const auto& [a, b] : finished.pairs) {
    for (const std::int32_t t : {a, b}) {
      const WallTriangle& triangle = result.triangles[t];
      for (const std::int32_t grain : {triangle.inner, triangle.outer}) {
        if (grain >= 0) result.grains[grain].intersects = true;
      }
    }
  }
  result.volume_error = finished.volume_error;
  const std::vector<double> got = wall_volumes(result, volumes.size());
  for (std::size_t g = 0; g < got.size(); ++g) result.grains[g].volume = got[g];
  count_nodes(result);
  measure_walls(result);
  measure_edges(result);
}

/// Returns the edge length of each body that has about `nodes` of them: a closed mesh has twice as
/// many triangles, here regular ones.
std::vector<double> edges_for(const WallComplex& walls, std::size_t bodies, int nodes) {
  std::vector<double> areas(bodies, 0.0);
  for (const WallTriangle& t : walls.triangles) {
    const double area = triangle_area(walls.points[t.corners[0]], walls.points[t.corners[1]],
                                      walls.points[t.corners[2]]);
    for (const std::int32_t body : {t.inner, t.outer}) {
      if (body >= 0) areas[body] += area;
    }
  }
  const double of_triangles = std::sqrt(0.75) * nodes;  // edges squared
  for (double& area : areas) area = std::sqrt(area / of_triangles);
  return areas;
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
                                const Execution& execution, const std::vector<Label>& labels) {
  check_conforming_options(options);
  if (grains == 0) refuse("There is no grain to remesh.");
  const double voxel = longest_voxel_edge(geometry);
  const double size = portable::cbrt(geometry.voxel_volume());
  const double edge = options.edge_length > 0.0 ? options.edge_length : std::max(voxel, 3.0 * size);
  if (edge < voxel) {
    refuse("The edge length " + format_number(edge) + " is below a voxel's edge, " +
           format_number(voxel) + ". Give a larger one by " + mention(edge_length_option) + ".");
  }
  execution.report(0.0, "Finding the pieces of the grains");
  const std::vector<GrainPieces> pieces = keep_largest_pieces(voxels, grains);
  const TouchingGrains touching = touching_grains(voxels);
  remove_thin_parts(voxels);
  const std::vector<GrainPieces> cleaned = keep_largest_pieces(voxels, grains);
  const std::vector<std::int64_t> composed = compose(voxels, grains);
  ConformingGrains result;
  result.grains.resize(grains);
  std::vector<double> volumes(grains);
  std::vector<std::int64_t> own(grains);
  for (std::size_t g = 0; g < grains; ++g) {
    ConformingGrain& grain = result.grains[g];
    own[g] = pieces[g].voxels - pieces[g].pore_voxels + pieces[g].left_out;
    grain.voxels = cleaned[g].voxels - composed[g];
    grain.fallen_off = cleaned[g].left_out + composed[g];
    grain.gained = grain.voxels + grain.fallen_off - pieces[g].voxels;
    grain.pieces = pieces[g].pieces;
    grain.left_out = pieces[g].left_out + grain.fallen_off;
    grain.pore_voxels = pieces[g].pore_voxels;
    volumes[g] = static_cast<double>(grain.voxels) * geometry.voxel_volume();
    grain.voxel_volume = volumes[g];
    result.gained_voxels += grain.gained;
  }
  require_voxels(result.grains, own, labels);
  execution.report(0.1, "Finding the walls");
  VoxelWalls walls = voxel_walls(voxels);
  voxels = GrainVoxels({0, 0, 0});
  const DenseWalls dense(std::move(walls), options.smoothing, geometry, execution.part(0.15, 0.4));
  std::vector<double> edges = options.nodes > 0 ? edges_for(dense.walls(), grains, options.nodes)
                                                : edges_below(edge, volumes);
  remesh_walls(dense, volumes, std::move(edges), std::vector<double>(grains, voxel), options.nodes,
               false, result, execution.part(0.4, 1.0));
  std::size_t kept = 0;
  for (const CommonWall& wall : result.walls) kept += touching.count({wall.first, wall.second});
  result.walls_across = result.walls.size() - kept;
  result.lost_walls = touching.size() - kept;
  return result;
}

namespace {

IndexedMesh outer_surface(const WallComplex& complex) {
  IndexedMesh surface;
  surface.points = complex.points;
  for (const WallTriangle& t : complex.triangles) {
    if (t.outer < 0) surface.triangles.push_back(t.corners);
  }
  drop_unused_points(surface);
  return surface;
}

/// `edges`: of each body; at a wall the geometric mean of both.
void require_affordable(const WallComplex& walls, const std::vector<double>& edges,
                        const Sentence& remedy) {
  double triangles = 0.0;
  for (const WallTriangle& t : walls.triangles) {
    const auto& [a, b, c] = t.corners;
    const double area = triangle_area(walls.points[a], walls.points[b], walls.points[c]);
    const double square = edges[t.inner] * edges[t.outer < 0 ? t.inner : t.outer];
    triangles += area / (0.25 * std::sqrt(3.0) * square);
  }
  if (triangles <= most_wall_triangles) return;
  refuse("The walls would have about " + format_number(1e-6 * triangles, 3) +
         " million triangles, more than " + format_number(1e-6 * most_wall_triangles) +
         " million. " + remedy);
}

void measure_surface(const IndexedMesh& grain, double radius, ConformingGrains& remeshed,
                     const Execution& execution) {
  constexpr std::size_t samples = 5000;  // as in remesh()
  const MeshDistances distances =
      sampled_distances(outer_surface(remeshed), grain, samples, execution);
  remeshed.rms_distance = distances.root_mean_square / radius;
  remeshed.largest_distance = distances.largest / radius;
  remeshed.is_inaccurate = (remeshed.rms_distance > distance_warning_limit ||
                            remeshed.largest_distance > largest_warning_limit) &&
                           !has_voxel_steps(grain);
}

}  // namespace

ConformingGrains remesh_fragments(Fragments& fragments, const ConformingOptions& options,
                                  const Execution& execution) {
  check_conforming_options(options);
  ConformingGrains result;
  result.grains.resize(fragments.list.size());
  const std::vector<double> volumes = wall_volumes(fragments.walls, fragments.list.size());
  std::vector<double> edges =
      options.nodes > 0
          ? edges_for(fragments.walls, volumes.size(), options.nodes)
          : edges_below(options.edge_length > 0.0 ? options.edge_length : fragments.grain_edge,
                        volumes);
  require_affordable(fragments.walls, edges,
                     options.nodes > 0 ? Sentence("Give fewer nodes.")
                                       : "Give a larger " + mention(edge_length_option) + ".");
  // As of voxels, a third of the edges follows bent surfaces.
  std::vector<double> least = edges;
  for (double& edge : least) edge /= 3.0;
  const DenseWalls cut(fragments.walls);
  WallRemesher dense(cut, least);
  dense.refine(execution.part(0.0, 0.1));
  remesh_walls(DenseWalls(std::move(dense.mesh())), volumes, std::move(edges), least, options.nodes,
               true, result, execution.part(0.1, 0.9));
  measure_surface(outer_surface(fragments.walls), equivalent_radius(fragments.grain.volume), result,
                  execution.part(0.9, 0.95));
  fragments.walls = static_cast<const WallComplex&>(result);
  measure_fragments(fragments, execution.part(0.95, 1.0));
  return result;
}

}  // namespace wscvt
