// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/sample_elimination.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>
#include <queue>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

namespace bg = boost::geometry;

using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
/// A candidate's place and number.
using Entry = std::pair<Point, std::int32_t>;
using Tree = bg::index::rtree<Entry, bg::index::rstar<16>>;

constexpr std::size_t elimination_block = 512;

/// Candidates for each seed. Yuksel takes three to five; more make the spacing no more even.
constexpr int candidates_per_seed = 5;

/// A pair's share of crowding falls from 1 to 0 by this power of the distance (Yuksel 2015, eq. 3).
constexpr int crowding_power = 8;

/// Below this share of the largest possible spacing all distances count as one, so that a few pairs
/// of candidates that lie on each other do not decide the rest: beta and gamma of eq. 4.
double smallest_spacing_share() {
  constexpr double beta = 0.65;
  constexpr double gamma = 1.5;
  return (1.0 - std::pow(1.0 / candidates_per_seed, gamma)) * beta;
}

Point point_of(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

struct Candidates {
  std::vector<MeshPlace> places;
  std::vector<Vector3> points;
  std::vector<Vector3> normals;
  /// Square root of density / mean density: what distances count for; empty where all are one.
  std::vector<double> stretches;
};

Candidates candidates_of(const MappedSurface& surface, const std::vector<double>& densities,
                         int count) {
  Candidates result;
  result.places = area_uniform_places(
      surface.mesh(), candidates_per_seed * static_cast<std::size_t>(count), densities);
  double areas = 0.0;  // an area for each, of any common unit
  for (const MeshPlace& place : result.places) {
    result.points.push_back(surface.position(place));
    result.normals.push_back(surface.normal(place));
    if (densities.empty()) continue;
    const double density = value_at(surface.mesh(), densities, place);
    areas += 1.0 / density;
    result.stretches.push_back(density);
  }
  // The candidates lie by density, so 1 / mean density is the mean of 1 / density over them.
  const double mean_area = areas / static_cast<double>(result.places.size());
  for (double& stretch : result.stretches) stretch = std::sqrt(stretch * mean_area);
  return result;
}

/// A candidate that crowds another, and by how much.
struct Neighbour {
  std::int32_t candidate;
  double crowding;
};

/// For each candidate those that crowd it. `reach` is the distance from which none does, where the
/// density is the mean one: twice the spacing of the densest packing.
std::vector<std::vector<Neighbour>> neighbours_of(const Candidates& candidates, double reach,
                                                  const Execution& execution) {
  const std::size_t count = candidates.points.size();
  std::vector<Entry> entries;
  entries.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    entries.emplace_back(point_of(candidates.points[i]), static_cast<std::int32_t>(i));
  }
  const Tree tree(entries);
  const double nearest = reach * smallest_spacing_share();
  const bool is_even = candidates.stretches.empty();
  std::vector<std::vector<Neighbour>> result(count);
  execution.parallel_for(count, elimination_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3& here = candidates.points[i];
      // A pair's distance counts by the mean of both stretches, which is at least half of either.
      const Vector3 corner =
          Vector3::Constant(is_even ? reach : 2.0 * reach / candidates.stretches[i]);
      const auto add = [&](const Entry& entry) {
        const std::int32_t j = entry.second;
        if (j == static_cast<std::int32_t>(i)) return;
        if (!(candidates.normals[i].dot(candidates.normals[j]) > 0.0)) return;
        const double stretch =
            is_even ? 1.0 : 0.5 * (candidates.stretches[i] + candidates.stretches[j]);
        const double distance = stretch * (candidates.points[j] - here).norm();
        if (distance >= reach) return;
        const double share = 1.0 - std::max(distance, nearest) / reach;
        result[i].push_back({j, std::pow(share, crowding_power)});
      };
      tree.query(bg::index::intersects(Box(point_of(here - corner), point_of(here + corner))),
                 boost::make_function_output_iterator(add));
    }
  });
  return result;
}

/// Takes out the most crowded candidate until `count` are left; of equal ones the last.
std::vector<char> eliminate(const std::vector<std::vector<Neighbour>>& neighbours, int count) {
  std::vector<double> crowding(neighbours.size(), 0.0);
  std::vector<char> is_left(neighbours.size(), 1);
  std::priority_queue<std::pair<double, std::int32_t>> queue;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    for (const Neighbour& neighbour : neighbours[i]) crowding[i] += neighbour.crowding;
    queue.emplace(crowding[i], static_cast<std::int32_t>(i));
  }
  for (auto left = static_cast<int>(neighbours.size()); left > count; queue.pop()) {
    const auto [value, i] = queue.top();
    // Every change has put a new entry into the queue; the older ones are passed over.
    if (is_left[i] == 0 || value != crowding[i]) continue;
    is_left[i] = 0;
    --left;
    for (const Neighbour& neighbour : neighbours[i]) {
      const std::int32_t j = neighbour.candidate;
      if (is_left[j] == 0) continue;
      crowding[j] -= neighbour.crowding;
      queue.emplace(crowding[j], j);
    }
  }
  return is_left;
}

}  // namespace

std::vector<Vector3> spread_seeds(const MappedSurface& surface,
                                  const std::vector<double>& densities, int count,
                                  const Execution& execution) {
  if (count < 4) {
    throw Error(ErrorCode::InvalidInput,
                "A tessellation needs at least 4 seeds, not " + std::to_string(count) + ".");
  }
  const Candidates candidates = candidates_of(surface, densities, count);
  const IndexedMesh& mesh = surface.mesh();
  const double area = mesh_sums(mesh.points, mesh.triangles, mesh.points[0], execution).area();
  // Twice the radius of the discs of the densest packing in the plane.
  const double reach = 2.0 * std::sqrt(area / (2.0 * std::sqrt(3.0) * count));
  const std::vector<char> is_left = eliminate(neighbours_of(candidates, reach, execution), count);
  std::vector<Vector3> seeds;
  seeds.reserve(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < is_left.size(); ++i) {
    if (is_left[i] != 0) seeds.push_back(surface.direction(candidates.places[i]));
  }
  if (!SphereTriangulation::try_build(seeds)) return fibonacci_lattice(count);
  return seeds;
}

}  // namespace wscvt
