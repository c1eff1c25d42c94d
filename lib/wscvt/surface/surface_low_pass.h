// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A low-pass filter of functions on a closed triangle mesh. It uses the mesh's own Laplacian and
/// needs no map to a sphere or a plane.
///
/// With the lumped areas M and the cotangent matrix L of linear elements (Dziuk 1988, "Finite
/// elements for the Beltrami operator on arbitrary surfaces", Lect. Notes Math. 1357, 142-155) one
/// step is h = (M + t L)^(-1) M with t = (cutoff / 2 pi)^2, and the filter is p(h) = 10 h^3 - 15
/// h^4 + 6 h^5. For a wave of length w on a plane, the transmission is p(h) with h = 1 / (1 +
/// (cutoff / w)^2): 1/2 at the cut-off, as in ISO 16610, 0.942 at twice and 0.058 at half the
/// cut-off. p is flat at both ends, so it separates long and short waves far better than one step.
class SurfaceLowPass {
 public:
  /// For meshes with these triangles and `vertices` vertices. Finds the elimination order, which
  /// depends only on the triangles.
  SurfaceLowPass(const std::vector<Triangle>& triangles, std::size_t vertices);

  /// Sets the surface for the next values: the triangles between `points`. `cutoff` > 0: a
  /// wavelength, in the unit of the points. A face area below 1e-4 of the square of the longest
  /// edge counts as that area. Throws Error(InvalidInput) if the cut-off is not positive or the
  /// number of points is wrong, Error(NumericalFailure) if the equations have no solution.
  void set_surface(const std::vector<Vector3>& points, double cutoff, const Execution& execution);

  /// Returns the filtered values of three functions at the vertices, on the surface that was set
  /// last. Throws Error(InvalidInput) if the number of values is wrong.
  std::vector<Vector3> filter(const std::vector<Vector3>& values, const Execution& execution) const;

 private:
  using SparseMatrix = Eigen::SparseMatrix<double>;

  void check_count(std::size_t count) const;

  std::vector<Triangle> triangles_;
  std::size_t vertices_ = 0;
  Eigen::VectorXd areas_;
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> solver_;
};

}  // namespace wscvt
