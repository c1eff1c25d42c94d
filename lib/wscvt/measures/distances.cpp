// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/distances.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/box_grid.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t distance_block = 256;

constexpr const char* distance_stage = "Measuring distances";

}  // namespace

void check_densities(const IndexedMesh& mesh, const std::vector<double>& densities) {
  if (densities.empty() || densities.size() == mesh.points.size()) return;
  refuse("There are " + std::to_string(densities.size()) + " densities for a mesh of " +
         std::to_string(mesh.points.size()) + " vertices. Give one per vertex, or none.");
}

std::vector<MeshPlace> area_uniform_places(const IndexedMesh& mesh, std::size_t count,
                                           const std::vector<double>& densities) {
  check_densities(mesh, densities);
  std::vector<double> accumulated;
  accumulated.reserve(mesh.triangles.size());
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const double density =
        densities.empty() ? 1.0 : (densities[t[0]] + densities[t[1]] + densities[t[2]]) / 3.0;
    area += density * triangle_area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    accumulated.push_back(area);
  }
  if (!(area > 0.0)) {
    refuse(
        "The mesh has no area, so no points can be spread over it. Give a triangle mesh with "
        "area.");
  }

  std::vector<MeshPlace> places;
  places.reserve(count);
  std::size_t face = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<double>(i);
    const double place = (index + 0.5) / static_cast<double>(count) * area;
    while (face + 1 < accumulated.size() && accumulated[face] < place) ++face;
    Eigen::Vector2d at = plastic_point(i);
    if (at.sum() > 1.0) at = Eigen::Vector2d::Ones() - at;
    places.push_back({static_cast<std::int32_t>(face), {1.0 - at.x() - at.y(), at.x(), at.y()}});
  }
  return places;
}

std::vector<Vector3> area_uniform_samples(const IndexedMesh& mesh, std::size_t count) {
  std::vector<Vector3> samples;
  samples.reserve(count);
  for (const MeshPlace& place : area_uniform_places(mesh, count)) {
    samples.push_back(point_at(mesh, place));
  }
  return samples;
}

namespace {

/// Squares of distances, of which the smallest of several parts are wanted.
struct SmallestSquares {
  std::vector<double> values;

  SmallestSquares& operator+=(const SmallestSquares& other) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::min(values[i], other.values[i]);
    }
    return *this;
  }
};

/// Faces near which points are looked for, per point.
constexpr std::size_t first_faces_a_point = 4;

/// Returns the distances from points to a mesh of many more faces, as a tree of all faces would
/// give them: such a tree takes six times the memory of the mesh. A tree of a few faces, spread
/// evenly by area, gives each point a ball in which its nearest face lies; then all faces are
/// looked through once. Returns nothing if the balls are too large for that.
std::vector<double> distances_to_many(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                                      const Execution& execution) {
  IndexedMesh few;
  std::int32_t last = -1;
  for (const MeshPlace& place : area_uniform_places(mesh, first_faces_a_point * points.size())) {
    if (place.triangle == std::exchange(last, place.triangle)) continue;
    const auto corner = static_cast<std::int32_t>(few.points.size());
    for (const std::int32_t v : mesh.triangles[place.triangle])
      few.points.push_back(mesh.points[v]);
    few.triangles.push_back({corner, corner + 1, corner + 2});
  }
  if (!has_area(few)) return {};
  const MeshDistance tree(few, execution, distance_stage);
  SmallestSquares bounds;
  std::vector<BoxGrid::Box> balls;
  for (const double radius : tree.distances(points, execution)) {
    const Vector3& centre = points[balls.size()];
    balls.emplace_back(centre.array() - radius, centre.array() + radius);
    bounds.values.push_back(radius * radius);
  }
  constexpr int cells_a_side = 64;  // half or twice as many take as long
  const BoxGrid grid(std::move(balls), cells_a_side);
  if (grid.is_crowded()) return {};
  // Each part has all squares, so there are few parts.
  const std::size_t faces_a_part = std::max<std::size_t>(1 << 14, mesh.triangles.size() / 16 + 1);
  bounds = execution.parallel_sum(
      mesh.triangles.size(), faces_a_part, bounds, [&](std::size_t begin, std::size_t end) {
        SmallestSquares part = bounds;
        for (std::size_t f = begin; f < end; ++f) {
          const auto& [a, b, c] = mesh.triangles[f];
          const std::array<Vector3, 3> corners = {mesh.points[a], mesh.points[b], mesh.points[c]};
          const BoxGrid::Box box = box_of(corners);
          grid.visit(box, [&](std::int32_t ball) {
            const Vector3& point = points[ball];
            double& smallest = part.values[ball];
            if (box.squaredExteriorDistance(point) >= smallest ||
                !(triangle_area(corners[0], corners[1], corners[2]) > 0.0)) {
              return;
            }
            smallest = std::min(smallest, squared_distance_to_face(corners, point));
          });
        }
        return part;
      });
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const double square : bounds.values) distances.push_back(std::sqrt(square));
  return distances;
}

/// Returns the distances from points to a mesh. The way is chosen for few points and one use.
std::vector<double> distances_to(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                                 const Execution& execution) {
  execution.report(0.0, distance_stage);
  if (mesh.triangles.size() > 2 * first_faces_a_point * points.size()) {
    std::vector<double> distances = distances_to_many(mesh, points, execution);
    if (!distances.empty()) return distances;
  }
  return MeshDistance(mesh, execution).distances(points, execution);
}

struct DistanceSums {
  double sum = 0.0;
  double squares = 0.0;
  double maximum = 0.0;

  DistanceSums& operator+=(const DistanceSums& other) {
    sum += other.sum;
    squares += other.squares;
    maximum = std::max(maximum, other.maximum);
    return *this;
  }
};

DistanceSums sums_of(const std::vector<double>& distances, const Execution& execution) {
  return execution.parallel_sum(distances.size(), distance_block, DistanceSums(),
                                [&](std::size_t begin, std::size_t end) {
                                  DistanceSums part;
                                  for (std::size_t i = begin; i < end; ++i) {
                                    const double d = distances[i];
                                    part.sum += d;
                                    part.squares += d * d;
                                    part.maximum = std::max(part.maximum, d);
                                  }
                                  return part;
                                });
}

OneSidedDistance of_samples(const std::vector<double>& distances, const Execution& execution) {
  const DistanceSums sums = sums_of(distances, execution);
  const auto count = static_cast<double>(distances.size());
  return {sums.maximum, std::sqrt(sums.squares / count), sums.sum / count};
}

/// Returns the vertices that faces have.
std::vector<Vector3> vertices_of(const IndexedMesh& mesh) {
  std::vector<char> used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) used[v] = 1;
  }
  std::vector<Vector3> vertices;
  vertices.reserve(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (used[i] != 0) vertices.push_back(mesh.points[i]);
  }
  return vertices;
}

/// The larger of two squares, as a sum of parts.
struct LargestSquare {
  double value = 0.0;

  LargestSquare& operator+=(const LargestSquare& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

/// Samples and all vertices. A vertex costs little: its search ends at any face as near as the
/// largest distance so far.
OneSidedDistance one_sided(const IndexedMesh& from, const MeshDistance& to, std::size_t samples,
                           const Execution& execution) {
  OneSidedDistance result =
      of_samples(to.distances(area_uniform_samples(from, samples), execution), execution);
  const std::vector<Vector3> vertices = vertices_of(from);
  const LargestSquare sampled{result.maximum * result.maximum};
  const LargestSquare largest = execution.parallel_sum(
      vertices.size(), distance_block, sampled, [&](std::size_t begin, std::size_t end) {
        LargestSquare part = sampled;
        std::size_t near = 0;
        for (std::size_t i = begin; i < end; ++i) {
          part.value = std::max(part.value, to.squared_distance(vertices[i], near, part.value));
        }
        return part;
      });
  if (largest.value > sampled.value) result.maximum = std::sqrt(largest.value);
  return result;
}

MeshDistances both_of(const OneSidedDistance& to, const OneSidedDistance& from) {
  return {to, from, std::max(to.maximum, from.maximum),
          std::max(to.root_mean_square, from.root_mean_square)};
}

}  // namespace

void check_distance_options(const DistanceOptions& options) {
  require_in_range(options.samples, distance_samples_option);
}

MeshDistances measure_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                const DistanceOptions& options, const Execution& execution) {
  check_distance_options(options);
  execution.report(0.0, distance_stage);
  return measure_distances(mesh, reference, MeshDistance(reference, execution), options, execution);
}

MeshDistances measure_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                const MeshDistance& to_reference, const DistanceOptions& options,
                                const Execution& execution) {
  check_distance_options(options);
  execution.report(0.0, distance_stage);
  const OneSidedDistance to = one_sided(mesh, to_reference, options.samples, execution);
  execution.report(0.5, distance_stage);
  const OneSidedDistance from =
      one_sided(reference, MeshDistance(mesh, execution), options.samples, execution);
  execution.report(1.0, distance_stage);
  return both_of(to, from);
}

MeshDistances sampled_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                std::size_t samples, const Execution& execution) {
  check_distance_options({samples});
  std::vector<Vector3> points = area_uniform_samples(mesh, samples);
  const std::vector<Vector3> vertices = vertices_of(mesh);
  points.insert(points.end(), vertices.begin(), vertices.end());
  std::vector<double> distances = distances_to(reference, points, execution);
  const double largest = *std::max_element(distances.begin(), distances.end());
  distances.resize(samples);
  OneSidedDistance to = of_samples(distances, execution);
  to.maximum = largest;
  return both_of(to, one_sided(reference, MeshDistance(mesh, execution), samples, execution));
}

double rms_distance(const IndexedMesh& from, const IndexedMesh& to, std::size_t samples,
                    const Execution& execution) {
  check_distance_options({samples});
  return of_samples(distances_to(to, area_uniform_samples(from, samples), execution), execution)
      .root_mean_square;
}

void scale(MeshDistances& distances, double unit) {
  for (OneSidedDistance* side : {&distances.to_reference, &distances.from_reference}) {
    side->maximum *= unit;
    side->root_mean_square *= unit;
    side->mean *= unit;
  }
  distances.largest *= unit;
  distances.root_mean_square *= unit;
}

}  // namespace wscvt
