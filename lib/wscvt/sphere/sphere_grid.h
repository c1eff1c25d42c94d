// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Fills `values` (end - begin of them) for the points [begin, end) of an array; called from
/// several threads at once.
using PointValueFunction = std::function<void(std::size_t begin, std::size_t end, double* values)>;

/// A field tabulated on an equal-angle grid of the sphere: rows at theta = (j + 1/2) pi / rows,
/// columns at phi = k pi / rows, 2 rows of them. Over a pole a field goes on in the row half a turn
/// away, so the grid has no edge.
///
/// Look-up is by local Lagrange interpolation over stencil x stencil nodes, which errs by at most
/// C (degree pi / rows)^stencil of a harmonic's size, C = 0.024 (stencil 4) or 0.005 (stencil 6),
/// in each of the two angles. It is continuous, but only piecewise smooth.
class SphereGrid {
 public:
  /// All zero. Throws Error(InvalidInput) unless rows >= 8, stencil 4 or 6.
  SphereGrid(int rows, int stencil);

  /// Takes over node values, row by row. Throws as the first, and Error(InvalidInput) unless there
  /// are rows x 2 rows of them.
  SphereGrid(int rows, int stencil, const std::vector<double>& values);

  int rows() const { return rows_; }

  /// Cosines and sines of theta of the rows of a grid.
  static std::vector<double> row_cosines(int rows);
  static std::vector<double> row_sines(int rows);

  /// Unit vectors of the nodes of a grid, row by row.
  static std::vector<Vector3> directions(int rows);

  /// Node values, row by row.
  std::vector<double> values() const;

  /// The interpolated field in `count` directions (unit vectors). May be called from several
  /// threads at once; the value for one does not depend on the others.
  void interpolate(const Vector3* directions, std::size_t count, double* values) const;

  /// The same of several fields at once, each into its own array: finding a direction's place on
  /// the grid is more than half of a look-up. Throws Error(InvalidInput) unless all `grids` have
  /// the rows and the stencil of the first and there is an array for each.
  static void interpolate(const std::vector<const SphereGrid*>& grids, const Vector3* directions,
                          std::size_t count, const std::vector<double*>& values);

  /// The transpose of `interpolate`: every point's value is shared out over its stencil, so that
  /// the sum over the nodes of (node value x f) is the sum over the points of (value x f) for every
  /// f the interpolation reproduces. Same bytes on any number of threads. Throws as the first
  /// constructor.
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
