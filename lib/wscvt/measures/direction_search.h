// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/pi.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {

/// A direction and what was searched for in it.
struct DirectionMinimum {
  Vector3 direction = Vector3::UnitX();
  double value = 0.0;
};

/// Follows a function of directions downhill from `start` with steps from `first` down to `last`
/// radians: to the best of eight neighbours, and where none is better with half the step and the
/// eight turned, so that a valley with a kink along it is followed as well.
template <class Function>
DirectionMinimum descend(const Function& function, DirectionMinimum start, double first,
                         double last) {
  constexpr double golden_angle = 2.399963229728653;
  double turn = 0.0;
  for (double step = first; step > last;) {
    const Vector3 across = start.direction.unitOrthogonal();
    const Vector3 beyond = start.direction.cross(across);
    DirectionMinimum best = start;
    for (int k = 0; k < 8; ++k) {
      const double angle = turn + 0.25 * pi * k;
      const Vector3 tried =
          (start.direction + step * (std::cos(angle) * across + std::sin(angle) * beyond))
              .normalized();
      const double value = function(tried);
      if (value < best.value) best = {tried, value};
    }
    turn += golden_angle;
    if (best.value < start.value) {
      start = best;
    } else {
      step *= 0.5;
    }
  }
  return start;
}

/// The smallest value of a function that is the same for a direction and its opposite: on a lattice
/// of 250 of them, then downhill from the eight best, the three best of these to 1e-7 radians. The
/// lattice stands in `frame`: one that turns with the body makes the result turn with it.
template <class Function>
DirectionMinimum smallest_over_directions(const Function& function, const Eigen::Matrix3d& frame,
                                          const char* stage, const Execution& execution) {
  constexpr int lattice = 500;
  constexpr std::size_t followed = 8;
  constexpr std::size_t finished = 3;
  constexpr double spacing = 0.16;  // of the lattice, radians
  constexpr double coarse = 0.01;
  constexpr double fine = 1e-7;
  const auto by_value = [](const DirectionMinimum& a, const DirectionMinimum& b) {
    return a.value < b.value;
  };
  std::vector<DirectionMinimum> found;
  for (const Vector3& u : fibonacci_lattice(lattice)) {
    if (u.z() < 0.0) continue;
    execution.report(0.0, stage);
    const Vector3 direction = frame * u;
    found.push_back({direction, function(direction)});
  }
  std::stable_sort(found.begin(), found.end(), by_value);
  found.resize(followed);
  for (DirectionMinimum& one : found) {
    execution.report(0.3, stage);
    one = descend(function, one, spacing, coarse);
  }
  std::stable_sort(found.begin(), found.end(), by_value);
  found.resize(finished);
  for (DirectionMinimum& one : found) {
    execution.report(0.6, stage);
    one = descend(function, one, coarse, fine);
  }
  return *std::min_element(found.begin(), found.end(), by_value);
}

/// The points that lie farthest in each of 2,000 directions of a lattice that stands in `frame`, or
/// all points where they are fewer. Reports `stage` once a direction.
std::vector<Vector3> extreme_points(const std::vector<Vector3>& points,
                                    const Eigen::Matrix3d& frame, const char* stage,
                                    const Execution& execution);

/// Axes of a point set's second moments: they turn with the points.
Eigen::Matrix3d frame_of(const std::vector<Vector3>& points);

}  // namespace wscvt
