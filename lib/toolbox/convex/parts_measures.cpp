// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "toolbox/convex/convex_body.h"
#include "toolbox/convex/convex_parts.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_warnings.h"

namespace wscvt {

namespace {

/// The parts, with a quick test for points outside all parts.
class Union {
 public:
  explicit Union(const ConvexParts& parts) {
    for (const IndexedMesh& part : parts) {
      bodies_.push_back(convex_body(part.points));
      boxes_.emplace_back();
      for (const Vector3& p : part.points) {
        boxes_.back().extend(p);
        box_.extend(p);
      }
    }
  }

  const std::vector<ConvexBody>& bodies() const { return bodies_; }
  const Eigen::AlignedBox3d& box() const { return box_; }

  /// Returns the number of parts that contain the point.
  int count(const Vector3& point) const {
    int count = 0;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      if (boxes_[k].contains(point) && bodies_[k].excess(point) < 0.0) ++count;
    }
    return count;
  }

 private:
  std::vector<ConvexBody> bodies_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  Eigen::AlignedBox3d box_;
};

double shared_volume(const Union& parts, const Execution& execution) {
  constexpr int cells = 96;
  const Vector3 size = parts.box().sizes();
  const double spacing = size.maxCoeff() / cells;
  const auto counts = (size / spacing).array().ceil().cast<int>();
  const auto layers = static_cast<std::size_t>(counts[2]);
  const double shared = execution.parallel_sum(layers, 1, 0.0, [&](std::size_t k, std::size_t) {
    int more = 0;
    for (int j = 0; j < counts[1]; ++j) {
      for (int i = 0; i < counts[0]; ++i) {
        const Vector3 middle =
            parts.box().min() + spacing * Vector3(i + 0.5, j + 0.5, static_cast<double>(k) + 0.5);
        more += std::max(0, parts.count(middle) - 1);
      }
    }
    return static_cast<double>(more);
  });
  return shared * spacing * spacing * spacing;
}

/// Returns the volume of the union of all parts.
double union_volume(const Union& parts, double shared) {
  double volume = -shared;
  for (const ConvexBody& body : parts.bodies()) volume += body.volume;
  return volume;
}

/// Scales the parts together about the grain's centroid, so that their union has its volume. Hulls
/// hold the grain and have more; hulls of few faces have less. Returns the factor.
double keep_volume(ConvexParts& parts, const ShapeDescriptors& grain, const Execution& execution) {
  const Union all(parts);
  const double scale =
      portable::cbrt(grain.volume / union_volume(all, shared_volume(all, execution)));
  for (IndexedMesh& part : parts) {
    for (Vector3& p : part.points) p = grain.centroid + scale * (p - grain.centroid);
  }
  return scale;
}

std::vector<Vector3> outer_points(const ConvexParts& parts, const Union& all) {
  constexpr std::size_t samples = 20000;
  // A slit between two parts is inside the grain and tells nothing of its surface. On sand_7228 in
  // 12 parts, slits of 1e-4 of the size count as 8.8 % of the radius, where the surface is 5.3 %
  // off.
  const double beyond = 1e-3 * all.box().sizes().norm();
  const IndexedMesh mesh = joined(parts);
  std::vector<Vector3> points;
  for (const MeshPlace& place : area_uniform_places(mesh, samples)) {
    const Vector3 normal = doubled_area_normal(mesh, place.triangle).normalized();
    const Vector3 point = point_at(mesh, place);
    // The other part lies beyond a face that two parts share.
    if (all.count(point + beyond * normal) == 0) points.push_back(point);
  }
  return points;
}

/// Ordinary grains in four parts are 6 to 8 % off, their hulls 9 to 18 %. `scale`: of keep_volume.
void warn_of_distance(double scale, PartsResult& result) {
  constexpr double limit = 0.2;
  const double share =
      result.measures.largest_distance / equivalent_radius(result.measures.grain_volume);
  if (share < limit) return;
  const Sentence why =
      scale > 1.0 ? "have too few faces. Compare with larger " + mention(convex_faces_option)
                  : "fill a hollow of it. Compare with a larger " + mention(convex_parts_option);
  result.warnings.push_back(Sentence("The parts are up to ") + format_percent(share) +
                            " of the equivalent radius from the grain: they " + why +
                            ", or use the remesh where the difference matters.");
}

}  // namespace

std::vector<Vector3> outer_points(const ConvexParts& parts) {
  return outer_points(parts, Union(parts));
}

PartsMeasures measure_parts(const ConvexParts& parts, const IndexedMesh& grain,
                            const Execution& execution) {
  if (parts.empty()) refuse("There is no convex part with a volume. Give closed convex meshes.");
  const Union all(parts);
  PartsMeasures measures;
  measures.grain_volume = volume_of(grain, execution);
  if (!(measures.grain_volume > 0.0)) {
    refuse("The grain encloses no positive volume. Give a closed mesh whose faces look outward.");
  }
  measures.shared_volume = shared_volume(all, execution);
  measures.parts_volume = union_volume(all, measures.shared_volume);

  const MeshDistance to_grain(grain, execution);
  const std::vector<Vector3> points = outer_points(parts, all);
  double squares = 0.0;
  for (const double d : to_grain.distances(points, execution)) {
    squares += d * d;
    measures.largest_distance = std::max(measures.largest_distance, d);
  }
  measures.rms_distance =
      std::sqrt(squares / static_cast<double>(std::max<std::size_t>(points.size(), 1)));

  std::vector<Vector3> outside;
  for (const Vector3& p : grain.points) {
    const bool is_held = std::any_of(all.bodies().begin(), all.bodies().end(),
                                     [&](const ConvexBody& body) { return body.excess(p) <= 0.0; });
    if (!is_held) outside.push_back(p);
  }
  if (!outside.empty()) {
    const MeshDistance to_parts(joined(parts), execution);
    for (const double d : to_parts.distances(outside, execution)) {
      measures.largest_gap = std::max(measures.largest_gap, d);
    }
  }
  return measures;
}

PartsResult make_parts(IndexedMesh scan, RemeshOptions remesh_options, const ConvexOptions& options,
                       const Execution& execution) {
  check_options(options);
  remesh_options.measures.repaired_scan = true;
  RemeshResult remeshed = remesh(std::move(scan), remesh_options, execution.part(0.0, 0.3));
  PartsResult result;
  // The parts do not inherit the remesh's faults, because they are made of the scan.
  result.warnings = scan_warnings(remeshed);
  result.scan = remeshed.scan;
  result.grain = std::move(remeshed.repaired_scan);
  result.parts = convex_parts(remeshed.mesh, result.grain, options, execution.part(0.3, 0.9));
  const double scale = keep_volume(result.parts, result.scan, execution.part(0.9, 0.9));
  result.measures = measure_parts(result.parts, result.grain, execution.part(0.9, 1.0));
  warn_of_distance(scale, result);
  return result;
}

}  // namespace wscvt
