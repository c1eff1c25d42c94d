// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/smoothed_curvature.h"

#include <cmath>

namespace wscvt {

namespace {

constexpr std::size_t curvature_block = 1024;

}  // namespace

GridField smoothed_curvature(const TabulatedSurface& table, CurvatureSquare square,
                             const Execution& execution) {
  const int rows = table.rows();
  const double radius = 0.6 * std::sqrt(4.0 * pi / table.node_count());
  GridField moment(rows);
  GridField measure(rows);
  const std::size_t columns = moment.columns();
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
  const std::vector<double> moments = sum_over_caps(moment, radius, execution).sums;
  const std::vector<double> measures = sum_over_caps(measure, radius, execution).sums;
  GridField result(rows);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = std::sqrt(moments[i] / measures[i]);
  }
  return result;
}

}  // namespace wscvt
