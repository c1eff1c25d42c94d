// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_target.h"

#include <algorithm>

#include "wscvt/base/triangle_geometry.h"
#include "wscvt/nodes/normal_least_squares.h"

namespace wscvt {

namespace {

/// A triangle has three unknown heights; ten samples for each of these leave its plane to the
/// surface and not to where the samples happen to lie.
constexpr std::size_t samples_per_triangle = 32;
/// Few nodes stand for large parts of the original, whose detail a few samples would miss.
constexpr std::size_t smallest_sample_count = 50000;
/// 60 bytes a sample at most and 4 in a list: half a gigabyte. On so many triangles that this
/// leaves less than four samples each, four are taken all the same, one more than determine a
/// plane.
constexpr std::size_t largest_sample_count = 8000000;
constexpr std::size_t least_samples_per_triangle = 4;

std::size_t sample_count(std::size_t triangles) {
  return std::clamp(samples_per_triangle * triangles, smallest_sample_count,
                    std::max(largest_sample_count, least_samples_per_triangle * triangles));
}

Eigen::Vector3f face_normal(const IndexedMesh& mesh, std::int32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return doubled_area_normal(mesh.points[a], mesh.points[b], mesh.points[c])
      .normalized()
      .cast<float>();
}

}  // namespace

RefinementSamples RadialTarget::samples(std::size_t triangles, const Execution& execution) const {
  const IndexedMesh& mesh = scan_.mesh();
  const std::vector<MeshPlace> places = area_uniform_places(mesh, sample_count(triangles));
  RefinementSamples samples;
  samples.points.resize(places.size());
  std::vector<Vector3> directions(places.size());
  execution.parallel_for(places.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      samples.points[i] = point_at(mesh, places[i]);
      directions[i] = samples.points[i].normalized();
    }
  });
  const std::vector<double> radii = scan_.radii(directions, execution);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    // The ray's hit and the sample are the same point of the same face up to rounding, some 1e-16
    // of the radius over the cosine of the face's tilt.
    if (!(samples.points[i].norm() > (1.0 - 1e-9) * radii[i])) continue;
    samples.points[kept++] = samples.points[i];
    samples.normals.push_back(face_normal(mesh, places[i].triangle));
  }
  samples.points.resize(kept);
  return samples;
}

RefinementNode RadialTarget::node_at(const Vector3& position,
                                     const RefinementNode& /*from*/) const {
  return {position, position, {}};
}

double RadialTarget::residual(const RefinementNode& node, Vector3& normal) const {
  const Vector3 direction = node.position.normalized();
  RadialJet jet;
  scan_.evaluate(&direction, 1, Derivatives::First, &jet);
  normal = surface_normal(jet, direction);
  return normal.dot(direction) * (jet.radius - node.position.norm());
}

RefinementSamples MappedTarget::samples(std::size_t triangles, const Execution& execution) const {
  const std::vector<MappedSample> mapped =
      mapped_samples(surface_, to_scan_, sample_count(triangles), execution);
  RefinementSamples samples;
  samples.points.reserve(mapped.size());
  samples.directions.reserve(mapped.size());
  samples.normals.reserve(mapped.size());
  for (const MappedSample& sample : mapped) {
    samples.points.push_back(sample.point);
    samples.directions.push_back(sample.direction);
    samples.normals.push_back(face_normal(surface_.mesh(), sample.triangle));
  }
  return samples;
}

RefinementNode MappedTarget::node_at(const Vector3& position, const RefinementNode& from) const {
  const MeshPlace place = surface_.nearest(position, from.place);
  return {position, surface_.direction(place), place};
}

double MappedTarget::residual(const RefinementNode& node, Vector3& normal) const {
  normal = surface_.normal(node.place);
  const Vector3 point = surface_.position(node.place);
  return normal.dot((to_scan_ == nullptr ? point : to_scan_->nearest_point(point)) - node.position);
}

}  // namespace wscvt
