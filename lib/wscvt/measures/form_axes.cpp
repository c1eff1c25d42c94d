// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/form_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/measures/direction_search.h"
#include "wscvt/measures/planar_hull.h"
#include "wscvt/scan/coordinates.h"

namespace wscvt {

namespace {

constexpr const char* box_stage = "Turning the bounding box";

/// The smallest box about some points with one edge along a direction.
class BoxAlong {
 public:
  explicit BoxAlong(const std::vector<Vector3>& points) : points_(points) {}

  struct Box {
    double volume = 0.0;
    std::array<Vector3, 3> axes;  ///< unit vectors along its edges
  };

  Box box(const Vector3& direction) const {
    const Vector3 x = direction.unitOrthogonal();
    const Vector3 y = direction.cross(x);
    std::vector<Vector2> flat;
    flat.reserve(points_.size());
    double lowest = direction.dot(points_.front());
    double highest = lowest;
    for (const Vector3& p : points_) {
      const double height = direction.dot(p);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
      flat.emplace_back(x.dot(p), y.dot(p));
    }
    const Rectangle rectangle = smallest_rectangle(planar_hull(flat));
    const Vector3 along = rectangle.side.x() * x + rectangle.side.y() * y;
    return {(highest - lowest) * rectangle.area(), {direction, along, direction.cross(along)}};
  }

 private:
  const std::vector<Vector3>& points_;
};

/// From a box to one of its own edges as direction, while that makes it smaller.
BoxAlong::Box settled(const BoxAlong& about, BoxAlong::Box box) {
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
    throw Error(ErrorCode::InvalidInput, "A box about " + std::to_string(points.size()) +
                                             " points has no volume; give at least four points.");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    throw Error(ErrorCode::InvalidInput, "Point " + std::to_string(i) +
                                             " has a coordinate that is not a finite number, so "
                                             "there is no box about it; remove it.");
  }
  check_scan_size(points);
  const std::vector<Vector3> local = in_frame(points, points.front(), frame_of(points));
  const std::vector<Vector3> extremes =
      extreme_points(local, thinning_directions, box_stage, execution);
  const std::vector<Vector3> few =
      extreme_points(extremes, coarse_directions, box_stage, execution);
  const BoxAlong about(local);
  const auto volume_about = [](const std::vector<Vector3>& some) {
    return [box = BoxAlong(some)](const Vector3& direction) { return box.box(direction).volume; };
  };
  const DirectionMinimum smallest = smallest_over_directions(
      volume_about(few), volume_about(extremes), volume_about(local), box_stage, execution);
  const BoxAlong::Box box = settled(about, about.box(smallest.direction));

  std::array<double, 3> edges{};
  for (std::size_t k = 0; k < 3; ++k) {
    double lowest = 0.0;  // the first point is the origin
    double highest = 0.0;
    for (const Vector3& p : local) {
      const double place = box.axes[k].dot(p);
      lowest = std::min(lowest, place);
      highest = std::max(highest, place);
    }
    edges[k] = highest - lowest;
  }
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
  ratios.krumbein_sphericity = std::cbrt((i / l) * (s / l));
  return ratios;
}

}  // namespace wscvt
