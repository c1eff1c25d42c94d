// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A low-pass filter of functions on a closed triangle mesh, by the mesh's own Laplacian, so that
/// it needs no sphere and no plane to lie over.
///
/// With the lumped areas M and the cotangent matrix L of linear elements (Dziuk 1988, "Finite
/// elements for the Beltrami operator on arbitrary surfaces", Lect. Notes Math. 1357, 142-155) one
/// step is h = (M + t L)^(-1) M with t = (cutoff / 2 pi)^2, and the filter is
/// p(h) = 10 h^3 - 15 h^4 + 6 h^5. A wave of length w on a plane is passed by p(h) with
/// h = 1 / (1 + (cutoff / w)^2): 1/2 at the cut-off as ISO 16610 asks for, 0.942 at twice, 0.058 at
/// half of it. p is flat at both ends, so that long waves are passed and short ones stopped far
/// better than by one step.
class SurfaceLowPass {
 public:
  /// For meshes of these triangles between so many vertices. The elimination order hangs on them
  /// alone and is found once, here.
  SurfaceLowPass(const std::vector<Triangle>& triangles, std::size_t vertices);

  /// Takes the surface of the triangles between `points` for the next values. `cutoff` > 0: a wave
  /// length, in the unit of the points. Faces thinner than 1e-4 of the square of their longest edge
  /// count as that large. Throws Error(InvalidInput) for a cut-off that is not positive and for
  /// another number of points, Error(NumericalFailure) where the equations have no solution.
  void set_surface(const std::vector<Vector3>& points, double cutoff, const Execution& execution);

  /// Returns the filtered values of three functions that are given at the vertices, on the surface
  /// that was set last. Throws Error(InvalidInput) for another number of values.
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
