// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_grid.h"

namespace wscvt {

/// One number per grid node, and the rows' sines for integrals over the sphere.
struct GridField {
  int rows = 0;
  std::vector<double> sines;   ///< of the rows' polar angles
  std::vector<double> values;  ///< row by row

  explicit GridField(int rows_in)
      : rows(rows_in),
        sines(SphereGrid::row_sines(rows_in)),
        values(2 * static_cast<std::size_t>(rows_in) * rows_in, 0.0) {}
  std::size_t columns() const { return 2 * static_cast<std::size_t>(rows); }

  /// Integral over the sphere of f(value).
  template <class Function>
  double integral(const Function& f) const {
    double sum = 0.0;
    double measure = 0.0;
    for (int j = 0; j < rows; ++j) {
      double row = 0.0;
      for (std::size_t k = 0; k < columns(); ++k) row += f(values[j * columns() + k]);
      sum += sines[j] * row;
      measure += sines[j] * static_cast<double>(columns());
    }
    return 4.0 * pi * sum / measure;
  }
};

/// Returns the sums of `field` over caps of chord `radius` about every grid node, with weights
/// exp(-2 (d / radius)^2).
std::vector<double> sum_over_caps(const GridField& field, double radius,
                                  const Execution& execution);

}  // namespace wscvt
