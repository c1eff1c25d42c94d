// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Fills the end - begin `values` for the points [begin, end) of an array. Called from several
/// threads at once.
using PointValueFunction = std::function<void(std::size_t begin, std::size_t end, double* values)>;

/// A field tabulated on an equal-angle grid of the sphere: rows at theta = (j + 1/2) pi / rows, and
/// 2 rows columns at phi = k pi / rows. Beyond a pole a field continues in the row half a turn
/// away, so the grid has no edge.
///
/// Look-up is local Lagrange interpolation over stencil x stencil nodes. For a harmonic, its error
/// in each of the two angles is at most C (degree pi / rows)^stencil of the harmonic's size, with C
/// = 0.024 (stencil 4) or 0.005 (stencil 6). The result is continuous but only piecewise smooth.
class SphereGrid {
 public:
  /// Sets all nodes to zero. Throws Error(InvalidInput) unless rows >= 8 and stencil is 4 or 6.
  SphereGrid(int rows, int stencil);

  /// Copies node values, row by row. Throws as the first constructor, and Error(InvalidInput)
  /// unless there are rows x 2 rows values.
  SphereGrid(int rows, int stencil, const std::vector<double>& values);

  int rows() const { return rows_; }

  /// Cosines and sines of theta of the rows of a grid.
  static std::vector<double> row_cosines(int rows);
  static std::vector<double> row_sines(int rows);

  /// Unit vectors of the nodes of a grid, row by row.
  static std::vector<Vector3> directions(int rows);

  /// Node values, row by row.
  std::vector<double> values() const;

  /// Interpolates the field in `count` directions (unit vectors). Thread-safe. A value does not
  /// depend on the other directions.
  void interpolate(const Vector3* directions, std::size_t count, double* values) const;

  /// Computes the transpose of `interpolate`: spreads every point's value over its stencil. For
  /// every f that the interpolation reproduces, the sum over the nodes of (node value x f) then
  /// equals the sum over the points of (value x f). The bytes do not depend on the number of
  /// threads. Throws as the first constructor.
  static SphereGrid spread(int rows, int stencil, const std::vector<Vector3>& directions,
                           const PointValueFunction& point_values, const Execution& execution);

 private:
  void fill_halo();
  void fold_halo();
  void spread_block(const Vector3* directions, std::size_t count, const double* values);
  std::size_t columns() const;
  std::size_t stride() const;  ///< nodes from one row to the next
  std::size_t offset(int row, int column) const;

  int rows_;
  int stencil_;
  int halo_;                   ///< rows and columns beyond the grid on every side
  std::vector<double> nodes_;  ///< (rows + 2 halo) x (2 rows + 2 halo)
};

}  // namespace wscvt
