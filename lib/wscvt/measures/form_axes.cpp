// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/direction_search.h"
#include "wscvt/repair/coordinates.h"

namespace wscvt {

namespace {

constexpr const char* box_stage = "Turning the bounding box";

/// Directions for the extreme points of the second search.
constexpr int medium_directions = 600;

/// Twice the first steps of the search with extreme points, and with all points.
constexpr double medium_angle = 0.04;
constexpr double last_angle = 0.008;

/// A box with one edge along a direction.
struct Box {
  double volume = 0.0;
  std::array<Vector3, 3> axes;  ///< unit vectors along its edges
};

/// A direction and two perpendicular directions.
struct Frame {
  explicit Frame(const Vector3& direction)
      : z(direction), x(direction.unitOrthogonal()), y(direction.cross(x)) {}

  Vector2 flat(const Vector3& p) const { return {x.dot(p), y.dot(p)}; }
  std::vector<Vector2> flat(const std::vector<Vector3>& points) const {
    std::vector<Vector2> result;
    result.reserve(points.size());
    for (const Vector3& p : points) result.push_back(flat(p));
    return result;
  }

  Vector3 z;
  Vector3 x;
  Vector3 y;
};

/// Returns the smallest box about points with one edge along `direction`. `hull_of` returns planar
/// hulls.
template <class HullOf>
Box box_along(const Vector3& direction, const std::vector<Vector3>& points, const HullOf& hull_of) {
  const Frame frame(direction);
  std::vector<Vector2> flat = frame.flat(points);
  const Rectangle rectangle = smallest_rectangle(hull_of(flat));
  const Vector3 along = rectangle.side.x() * frame.x + rectangle.side.y() * frame.y;
  return {range_along(points, direction).width() * rectangle.area(),
          {direction, along, direction.cross(along)}};
}

/// Computes boxes for directions each near the direction before, as in a descent. Only points at
/// the body's rim, seen along these directions, count: a tenth of all points or less.
class NearbyBoxes {
 public:
  /// Directions within `angle` of each other, radians, are near.
  NearbyBoxes(const std::vector<Vector3>& points, double angle)
      : points_(points), largest_angle_(angle) {
    const Eigen::AlignedBox3d box = box_of(points);
    for (const Vector3& p : points) {
      diameter_ = std::max(diameter_, (2.0 * p - box.min() - box.max()).norm());
    }
  }

  Box box(const Vector3& direction) {
    follow(direction);
    constexpr std::size_t few = 150;
    return box_along(direction, rim_, rim_.size() > few ? planar_hull : planar_hull_of_few);
  }

 private:
  /// Number of directions from which the present spread is estimated.
  static constexpr int watched = 16;

  void follow(const Vector3& direction) {
    const double turned = rim_.empty() ? largest_angle_ : (direction - middle_).norm();
    if (rim_.empty() || turned > angle_) {
      rim_ = rim_of(points_, direction, std::min(2.0 * turned, largest_angle_));
    } else if (count_ < watched) {
      ++count_;
      spread_ = std::max(spread_, (direction - first_).norm());
      return;
    } else if (4.0 * spread_ < angle_ && turned + 2.0 * spread_ < angle_) {
      rim_ = rim_of(rim_, direction, 2.0 * spread_);
    }
    first_ = direction;
    count_ = 0;
    spread_ = 0.0;
  }

  /// Returns the points on the rim, or farthest ahead or behind, as seen along any direction within
  /// `angle` of `middle`. A turn by this angle moves two points apart ahead by at most the angle
  /// times their distance, and across by the angle times their difference ahead.
  std::vector<Vector3> rim_of(const std::vector<Vector3>& points, const Vector3& middle,
                              double angle) {
    middle_ = middle;
    angle_ = angle;
    const Frame frame(middle);
    std::vector<Vector2> flat = frame.flat(points);
    const std::vector<Vector2> hull = planar_hull(flat);
    const Range heights = range_along(points, middle);
    const double ahead = angle * diameter_;
    const double across = angle * (heights.width() + 0.5 * ahead);
    std::vector<Vector2> outward;
    std::vector<double> reach;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vector2 edge = hull[(k + 1) % hull.size()] - hull[k];
      outward.push_back(Vector2(edge.y(), -edge.x()).normalized());
      reach.push_back(outward.back().dot(hull[k]) - across);
    }
    std::vector<Vector3> rim;
    for (const Vector3& p : points) {
      const double height = middle.dot(p);
      bool matters = height > heights.highest - ahead || height < heights.lowest + ahead;
      const Vector2 place = frame.flat(p);
      for (std::size_t k = 0; k < outward.size() && !matters; ++k) {
        matters = outward[k].dot(place) >= reach[k];
      }
      if (matters) rim.push_back(p);
    }
    return rim;
  }

  const std::vector<Vector3>& points_;
  double largest_angle_;
  double diameter_ = 0.0;
  std::vector<Vector3> rim_;  ///< for directions within `angle_` of `middle_`
  Vector3 middle_ = Vector3::Zero();
  double angle_ = 0.0;
  // The directions since the rim was computed, and their spread from the first.
  Vector3 first_ = Vector3::Zero();
  int count_ = 0;
  double spread_ = 0.0;
};

/// Searches on from a box's own edges as directions, while the box becomes smaller.
Box settled(NearbyBoxes& about, Box box) {
  const auto volume = [&about](const Vector3& direction) { return about.box(direction).volume; };
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (std::size_t k = 1; k < 3; ++k) {
      const DirectionMinimum other =
          descend(volume, {box.axes[k], volume(box.axes[k])}, 1e-3, 1e-6);
      if (!(other.value < (1.0 - 1e-9) * box.volume)) continue;
      box = about.box(other.direction);
      smaller = true;
      break;
    }
  }
  return box;
}

}  // namespace

FormAxes oriented_box_axes(const std::vector<Vector3>& points, const Execution& execution) {
  if (points.size() < 4) {
    refuse("A box about " + std::to_string(points.size()) +
           " points has no volume. Give at least four points.");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    refuse(
        "Point " + std::to_string(i) +
        " has a coordinate that is not a finite number, so there is no box about it. Remove it.");
  }
  check_scan_size(points);
  const std::vector<Vector3> local = in_frame(points, points.front(), frame_of(points));
  const std::vector<Vector3> extremes =
      extreme_points(local, medium_directions, box_stage, execution);
  const std::vector<Vector3> few =
      extreme_points(extremes, coarse_directions, box_stage, execution);
  NearbyBoxes medium(extremes, medium_angle);
  NearbyBoxes about(local, last_angle);
  const DirectionMinimum smallest = smallest_over_directions(
      [&](const Vector3& direction) { return box_along(direction, few, planar_hull).volume; },
      [&](const Vector3& direction) { return medium.box(direction).volume; },
      [&](const Vector3& direction) { return about.box(direction).volume; }, box_stage, execution);
  const Box box = settled(about, about.box(smallest.direction));

  std::array<double, 3> edges{};
  for (std::size_t k = 0; k < 3; ++k) edges[k] = range_along(local, box.axes[k]).width();
  std::sort(edges.begin(), edges.end());
  return {edges[0], edges[1], edges[2]};
}

FormRatios form_ratios(const FormAxes& axes) {
  const double s = axes.shortest;
  const double i = axes.intermediate;
  const double l = axes.longest;
  FormRatios ratios;
  ratios.aspect_ratio = s / l;
  ratios.zingg_elongation = i / l;
  ratios.zingg_flatness = s / i;
  ratios.kong_fonseca_elongation = (l - i) / l;
  ratios.kong_fonseca_flatness = (i - s) / i;
  ratios.krumbein_sphericity = portable::cbrt((i / l) * (s / l));
  return ratios;
}

OrientationTensor orientation_tensor(const IndexedMesh& mesh, const Execution& execution) {
  constexpr std::size_t block_size = 8192;
  // The trace of the sum is the area.
  const Eigen::Matrix3d sum = execution.parallel_sum_of(
      mesh.triangles.size(), block_size, Eigen::Matrix3d(Eigen::Matrix3d::Zero()),
      [&](std::size_t f, Eigen::Matrix3d& part) {
        const Vector3 doubled_area = doubled_area_normal(mesh, f);
        const double length = doubled_area.norm();
        if (length > 0.0) part += 0.5 / length * doubled_area * doubled_area.transpose();
      });
  if (!(sum.trace() > 0.0)) {
    refuse(
        "The mesh has no area, so it has no surface orientation. Give a triangle mesh with area.");
  }
  OrientationTensor result;
  result.tensor = sum / sum.trace();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(result.tensor,
                                                              Eigen::EigenvaluesOnly);
  result.eigenvalues = solver.eigenvalues().reverse();
  const double largest = result.eigenvalues[0];
  result.compactness = result.eigenvalues[2] / largest;
  result.flakiness = (largest - result.eigenvalues[1]) / largest;
  result.rodness = (result.eigenvalues[1] - result.eigenvalues[2]) / largest;
  return result;
}

}  // namespace wscvt
