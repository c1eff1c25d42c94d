// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/surface_low_pass.h"

#include <algorithm>
#include <array>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/pi.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr const char* low_pass_stage = "Filtering the surface";

/// Doubled area below this share of the square of the longest edge: the cotangents of a thinner
/// face are so large that it would hold its corners together.
constexpr double thinnest = 1e-4;

using Triplet = Eigen::Triplet<double>;

/// M and L: M the sixth of the doubled areas of the faces about each vertex.
struct Operators {
  Eigen::VectorXd areas;
  std::vector<Triplet> entries;  ///< of M + t L, its lower half
};

Operators operators(const std::vector<Triangle>& triangles, const std::vector<Vector3>& points,
                    double t) {
  Operators result;
  result.areas = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points.size()));
  result.entries.reserve(9 * triangles.size());
  const auto add = [&](int row, int column, double value) {
    result.entries.emplace_back(std::max(row, column), std::min(row, column), value);
  };
  for (const Triangle& face : triangles) {
    std::array<Vector3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = points[index(face[k])];
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (p[following(k)] - p[k]).squaredNorm());
    }
    const double area = std::max(doubled_area_normal(p[0], p[1], p[2]).norm(), thinnest * longest);
    if (!(area > 0.0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = face[following(k)];
      const int j = face[preceding(k)];
      const double half_cotangent =
          0.5 * (p[following(k)] - p[k]).dot(p[preceding(k)] - p[k]) / area;
      result.areas[face[k]] += area / 6.0;
      add(face[k], face[k], area / 6.0);
      add(i, i, t * half_cotangent);
      add(j, j, t * half_cotangent);
      add(i, j, -t * half_cotangent);
    }
  }
  return result;
}

Eigen::SparseMatrix<double> matrix_of(const std::vector<Triplet>& entries, std::size_t vertices) {
  const auto size = static_cast<Eigen::Index>(vertices);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

SurfaceLowPass::SurfaceLowPass(const std::vector<Triangle>& triangles, std::size_t vertices)
    : triangles_(triangles), vertices_(vertices) {
  // Values do not matter for the order: each face connects its corners.
  std::vector<Triplet> entries;
  entries.reserve(6 * triangles.size());
  for (const Triangle& face : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = face[k];
      const int j = face[following(k)];
      entries.emplace_back(i, i, 1.0);
      entries.emplace_back(std::max(i, j), std::min(i, j), 1.0);
    }
  }
  solver_.analyzePattern(matrix_of(entries, vertices));
}

std::vector<Vector3> SurfaceLowPass::filter(const std::vector<Vector3>& points,
                                            const std::vector<Vector3>& values, double cutoff,
                                            const Execution& execution) {
  if (!(cutoff > 0.0)) {
    throw Error(ErrorCode::InvalidInput, "The cut-off length of the surface filter is " +
                                             format_number(cutoff) + "; give a positive length.");
  }
  if (points.size() != vertices_ || values.size() != vertices_) {
    throw Error(ErrorCode::InvalidInput,
                "The surface filter was made for " + std::to_string(vertices_) +
                    " vertices, and got " + std::to_string(points.size()) + " points and " +
                    std::to_string(values.size()) + " values; give one of each per vertex.");
  }
  execution.report(0.0, low_pass_stage);
  const double wave = cutoff / (2.0 * pi);
  const Operators o = operators(triangles_, points, wave * wave);
  solver_.factorize(matrix_of(o.entries, vertices_));
  if (solver_.info() != Eigen::Success) {
    throw Error(ErrorCode::NumericalFailure,
                "The surface filter's equations have no solution; check the mesh for vertices "
                "without faces.");
  }
  const auto rows = static_cast<Eigen::Index>(vertices_);
  Eigen::MatrixXd step(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) step.row(i) = values[static_cast<std::size_t>(i)];
  // p(h) by Horner's rule would need h of each power anew; the powers one after another are it.
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows, 3);
  constexpr std::array<double, 6> polynomial = {0.0, 0.0, 0.0, 10.0, -15.0, 6.0};
  for (std::size_t power = 1; power < polynomial.size(); ++power) {
    execution.report(static_cast<double>(power) / polynomial.size(), low_pass_stage);
    step = solver_.solve(o.areas.asDiagonal() * step).eval();
    if (polynomial[power] != 0.0) sum += polynomial[power] * step;
  }
  std::vector<Vector3> result(vertices_);
  for (Eigen::Index i = 0; i < rows; ++i) result[static_cast<std::size_t>(i)] = sum.row(i);
  return result;
}

}  // namespace wscvt
