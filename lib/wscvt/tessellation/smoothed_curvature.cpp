// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/smoothed_curvature.h"

#include <algorithm>
#include <cmath>

namespace wscvt {

namespace {

constexpr std::size_t curvature_block = 1024;

}  // namespace

GridField smoothed_curvature(const TabulatedSurface& table, CurvatureSquare square,
                             const Execution& execution) {
  const int rows = table.rows();
  const CurvatureSamples* const samples = table.samples();
  double radius = 0.6 * std::sqrt(4.0 * pi / table.node_count());
  GridField moment(rows);
  GridField measure(rows);
  const std::size_t columns = moment.columns();
  if (samples == nullptr) {
    const std::vector<Vector3> nodes = SphereGrid::directions(rows);
    execution.parallel_for(nodes.size(), curvature_block, [&](std::size_t begin, std::size_t end) {
      std::vector<LocalShape> shapes(end - begin);
      table.surface().evaluate_shapes(nodes.data() + begin, shapes.size(), Derivatives::Second,
                                      shapes.data());
      for (std::size_t i = begin; i < end; ++i) {
        const double share = moment.sines[i / columns];
        moment.values[i] = share * square(shapes[i - begin].curvatures);
        measure.values[i] = share;
      }
    });
  } else {
    for (std::size_t i = 0; i < samples->directions.size(); ++i) {
      const Vector3& u = samples->directions[i];
      const double theta = std::acos(std::clamp(u.z(), -1.0, 1.0));
      const double phi = std::atan2(u.y(), u.x());
      const int row = std::min(static_cast<int>(theta * rows / pi), rows - 1);
      const auto column = static_cast<std::size_t>(
          (static_cast<int>(std::lround(phi * rows / pi)) + 2 * rows) % (2 * rows));
      moment.values[row * columns + column] += samples->weights[i] * square(samples->curvatures[i]);
      measure.values[row * columns + column] += samples->weights[i];
    }
  }
  GridField result(rows);
  std::vector<char> known(result.values.size(), 0);
  // Samples may leave caps empty: those are looked for again in caps of twice the size.
  for (bool complete = false; !complete; radius *= 2.0) {
    const std::vector<double> moments = sum_over_caps(moment, radius, execution).sums;
    const std::vector<double> measures = sum_over_caps(measure, radius, execution).sums;
    complete = true;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      if (known[i] != 0) continue;
      if (measures[i] > 0.0) {
        result.values[i] = std::sqrt(moments[i] / measures[i]);
        known[i] = 1;
      } else {
        complete = false;
      }
    }
    if (radius > 2.0) break;
  }
  return result;
}

}  // namespace wscvt
