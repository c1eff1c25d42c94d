// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {

/// A direction and the function's value there.
struct DirectionMinimum {
  Vector3 direction = Vector3::UnitX();
  double value = 0.0;
};

/// Follows a function of directions downhill from `start`, with steps from `first` down to `last`
/// radians. Moves to the best of eight neighbours. If no neighbour is better, tries eight
/// directions between them, because a valley with a kink along its floor is narrow. Then halves the
/// step. A move must lower the value by a millionth: in a valley whose floor is nearly level, as of
/// the boxes about a round plate, thousands of smaller moves would follow.
template <class Function>
DirectionMinimum descend(const Function& function, DirectionMinimum start, double first,
                         double last) {
  constexpr double golden_angle = 2.399963229728653;
  constexpr int stars = 2;
  constexpr double least_gain = 1e-6;
  double turn = 0.0;
  int failed = 0;
  for (double step = first; step > last;) {
    const Vector3 across = start.direction.unitOrthogonal();
    const Vector3 beyond = start.direction.cross(across);
    DirectionMinimum best = start;
    for (int k = 0; k < 8; ++k) {
      const double angle = turn + 0.25 * pi * k;
      const Vector3 tried =
          (start.direction + step * (portable::cos(angle) * across + portable::sin(angle) * beyond))
              .normalized();
      const double value = function(tried);
      if (value < best.value) best = {tried, value};
    }
    turn += golden_angle;
    if (best.value < start.value - least_gain * std::abs(start.value)) {
      start = best;
      failed = 0;
    } else if (++failed == stars) {
      step *= 0.5;
      failed = 0;
    }
  }
  return start;
}

/// Finds the smallest value of a function that is equal for a direction and its opposite. `coarse`
/// and `medium` approximate it with fewer points. Evaluates `coarse` on a lattice of 500 directions
/// and follows it downhill from at most 32 of the lattice's best minima. Then follows `medium` from
/// the twelve best results, and `function` from the three best of these, with steps down to 1e-6
/// radians. If the result must turn with a body, give functions of the body in its own frame
/// (frame_of).
template <class Coarse, class Medium, class Function>
DirectionMinimum smallest_over_directions(const Coarse& coarse, const Medium& medium,
                                          const Function& function, const char* stage,
                                          const Execution& execution) {
  constexpr int lattice = 1000;
  constexpr double spacing = 0.112;  // of the lattice, radians
  constexpr std::size_t followed = 32;
  constexpr std::size_t finished = 12;
  constexpr std::size_t compared = 3;
  constexpr double coarse_turn = 0.01;
  constexpr double medium_turn = 1e-3;
  constexpr double last_turn = 1e-6;
  const auto by_value = [](const DirectionMinimum& a, const DirectionMinimum& b) {
    return a.value < b.value;
  };
  std::vector<DirectionMinimum> all;
  for (const Vector3& direction : fibonacci_lattice(lattice)) {
    if (direction.z() < 0.0) continue;
    execution.report(0.0, stage);
    all.push_back({direction, coarse(direction)});
  }
  // Starts only where no near direction is better, because otherwise the best could all lie in one
  // valley.
  const double near = portable::cos(1.7 * spacing);
  std::vector<DirectionMinimum> found;
  for (const DirectionMinimum& one : all) {
    const bool beaten = std::any_of(all.begin(), all.end(), [&](const DirectionMinimum& other) {
      return other.value < one.value && std::abs(other.direction.dot(one.direction)) > near;
    });
    if (!beaten) found.push_back(one);
  }
  const auto keep = [&](std::size_t count) {
    std::stable_sort(found.begin(), found.end(), by_value);
    found.resize(std::min(count, found.size()));
  };
  keep(followed);
  for (DirectionMinimum& one : found) {
    execution.report(0.3, stage);
    one = descend(coarse, one, spacing, coarse_turn);
  }
  const auto follow_by = [&](const auto& next, double first, double last) {
    for (DirectionMinimum& one : found) {
      execution.report(0.6, stage);
      one = descend(next, {one.direction, next(one.direction)}, first, last);
    }
  };
  keep(finished);
  follow_by(medium, 2.0 * coarse_turn, medium_turn);
  keep(compared);
  follow_by(function, 4.0 * medium_turn, last_turn);
  keep(1);
  return found.front();
}

/// Returns the farthest points in each of `directions` directions of a lattice, or all points if
/// they are fewer. Reports `stage` once per direction.
std::vector<Vector3> extreme_points(const std::vector<Vector3>& points, int directions,
                                    const char* stage, const Execution& execution);

/// Numbers of directions for the extreme points of a measurement, and of a search's beginning.
inline constexpr int thinning_directions = 2000;
inline constexpr int coarse_directions = 200;

/// The range of places along a direction.
struct Range {
  double lowest = 0.0;
  double highest = 0.0;
  double width() const { return highest - lowest; }
};

/// Returns the range of at least one point along a direction.
Range range_along(const std::vector<Vector3>& points, const Vector3& direction);

/// Returns the axes of a point set's second moments, which turn with the points. They are
/// right-handed; the first two point to where the points reach farther.
Eigen::Matrix3d frame_of(const std::vector<Vector3>& points);

/// Returns the points' coordinates in `frame`, about `origin`.
std::vector<Vector3> in_frame(const std::vector<Vector3>& points, const Vector3& origin,
                              const Eigen::Matrix3d& frame);

}  // namespace wscvt
