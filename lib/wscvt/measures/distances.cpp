// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/distances.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/plastic_sequence.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/face_boxes.h"
#include "wscvt/surface/mesh_place.h"

namespace wscvt {

namespace {

constexpr std::size_t distance_block = 256;

constexpr const char* distance_stage = "Measuring distances";

void require_target_faces(const IndexedMesh& mesh) {
  if (!mesh.triangles.empty()) return;
  throw Error(ErrorCode::InvalidInput,
              "The mesh has no faces, so no distance to it can be measured. Give a triangle mesh.");
}

void require_area(bool has_area) {
  if (has_area) return;
  throw Error(ErrorCode::InvalidInput,
              "All faces of the mesh are degenerate, so no distance to it can be measured. Give a "
              "mesh with area.");
}

}  // namespace

MeshDistance::MeshDistance(const IndexedMesh& mesh, const Execution& execution) {
  require_target_faces(mesh);
  boxes_ = std::make_unique<FaceBoxes>(mesh, execution, distance_stage);
  require_area(!boxes_->empty());
}

MeshDistance::~MeshDistance() = default;
MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;

double MeshDistance::distance(const Vector3& point) const { return boxes_->distance(point); }

Vector3 MeshDistance::nearest_point(const Vector3& point) const {
  return boxes_->nearest_point(point);
}

std::vector<MeshPlace> MeshDistance::nearest_places(const std::vector<Vector3>& points,
                                                    const Execution& execution) const {
  return boxes_->nearest_places(points, execution);
}

bool MeshDistance::contains(const Vector3& point) const {
  return boxes_->faces_met(point) % 2 == 1;
}

std::vector<double> MeshDistance::distances(const std::vector<Vector3>& points,
                                            const Execution& execution) const {
  return boxes_->distances(points, execution);
}

std::vector<double> MeshDistance::signed_distances(const std::vector<Vector3>& points,
                                                   const Execution& execution) const {
  std::vector<double> values = distances(points, execution);
  execution.parallel_for(points.size(), distance_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (contains(points[i])) values[i] = -values[i];
    }
  });
  return values;
}

void check_densities(const IndexedMesh& mesh, const std::vector<double>& densities) {
  if (densities.empty() || densities.size() == mesh.points.size()) return;
  throw Error(ErrorCode::InvalidInput,
              "There are " + std::to_string(densities.size()) + " densities for a mesh of " +
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
    throw Error(ErrorCode::InvalidInput,
                "The mesh has no area, so no points can be spread over it. Give a triangle mesh "
                "with area.");
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

OneSidedDistance of_samples(const IndexedMesh& from, const MeshDistance& to, std::size_t samples,
                            const Execution& execution) {
  const DistanceSums sums =
      sums_of(to.distances(area_uniform_samples(from, samples), execution), execution);
  const auto count = static_cast<double>(samples);
  return {sums.maximum, std::sqrt(sums.squares / count), sums.sum / count};
}

OneSidedDistance one_sided(const IndexedMesh& from, const MeshDistance& to, std::size_t samples,
                           const Execution& execution) {
  std::vector<char> used(from.points.size(), 0);
  for (const Triangle& t : from.triangles) {
    for (const std::int32_t v : t) used[v] = 1;
  }
  std::vector<Vector3> vertices;
  vertices.reserve(from.points.size());
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    if (used[i] != 0) vertices.push_back(from.points[i]);
  }
  OneSidedDistance result = of_samples(from, to, samples, execution);
  const DistanceSums corners = sums_of(to.distances(vertices, execution), execution);
  result.maximum = std::max(result.maximum, corners.maximum);
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
  const MeshDistance to_reference(reference, execution);
  const MeshDistance to_mesh(mesh, execution);
  return both_of(of_samples(mesh, to_reference, samples, execution),
                 of_samples(reference, to_mesh, samples, execution));
}

double rms_distance(const IndexedMesh& from, const IndexedMesh& to, std::size_t samples,
                    const Execution& execution) {
  check_distance_options({samples});
  return of_samples(from, MeshDistance(to, execution), samples, execution).root_mean_square;
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
