// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/cap_sums.h"

#include <algorithm>

#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

std::vector<double> sum_over_caps(const GridField& field, double radius,
                                  const Execution& execution) {
  const int rows = field.rows;
  const auto columns = static_cast<std::ptrdiff_t>(field.columns());
  const double spacing = pi / rows;
  const int reach = static_cast<int>(radius / spacing);
  const std::vector<double> cosines = SphereGrid::row_cosines(rows);
  std::vector<double> sums(field.values.size(), 0.0);
  execution.parallel_for(rows, 4, [&](std::size_t begin, std::size_t end) {
    std::vector<double> kernel;
    std::vector<double> thrice(3 * static_cast<std::size_t>(columns));
    std::vector<double> row_sums(static_cast<std::size_t>(columns));
    for (std::size_t j = begin; j < end; ++j) {
      const int row = static_cast<int>(j);
      double* target = sums.data() + j * columns;
      for (int other = std::max(0, row - reach); other <= std::min(rows - 1, row + reach);
           ++other) {
        kernel.clear();
        for (std::ptrdiff_t shift = 0; shift <= columns / 2; ++shift) {
          const double chord_square =
              2.0 - 2.0 * (cosines[row] * cosines[other] +
                           field.sines[row] * field.sines[other] *
                               portable::cos(spacing * static_cast<double>(shift)));
          if (shift > 0 && chord_square > radius * radius) break;
          kernel.push_back(portable::exp(-2.0 * chord_square / (radius * radius)));
        }
        // The source is repeated three times, so that no index wraps. The inner loop runs over all
        // columns for one shift, so that the compiler can vectorize it, and each column still adds
        // its terms in the order of the shifts.
        const double* source = field.values.data() + other * columns;
        for (std::ptrdiff_t k = 0; k < columns; ++k) {
          thrice[k] = thrice[k + columns] = thrice[k + 2 * columns] = source[k];
          row_sums[k] = kernel[0] * source[k];
        }
        const double* const middle = thrice.data() + columns;
        for (std::ptrdiff_t shift = 1; shift < static_cast<std::ptrdiff_t>(kernel.size());
             ++shift) {
          const double weight = kernel[shift];
          const double* const right = middle + shift;
          const double* const left = middle - shift;
          if (shift == columns / 2) {  // the same node in both directions
            for (std::ptrdiff_t k = 0; k < columns; ++k) row_sums[k] += weight * right[k];
          } else {
            for (std::ptrdiff_t k = 0; k < columns; ++k) {
              row_sums[k] += weight * (right[k] + left[k]);
            }
          }
        }
        for (std::ptrdiff_t k = 0; k < columns; ++k) target[k] += row_sums[k];
      }
    }
  });
  return sums;
}

}  // namespace wscvt
