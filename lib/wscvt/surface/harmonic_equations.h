// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Points of a least-squares fit: unit vectors, and a weight for each; the weights sum to 4 pi.
struct WeightedDirections {
  const std::vector<Vector3>& directions;
  std::vector<double> weights;
};

/// sum w_i values_i / 4 pi.
double weighted_mean(const WeightedDirections& points, const std::vector<double>& values,
                     const Execution& execution);

/// The weighted normal equations A a = b of a fit, A = sum w_i Y(u_i) Y(u_i)^T, which is near the
/// identity when the points cover the sphere.
class HarmonicEquations {
 public:
  virtual ~HarmonicEquations() = default;

  /// Sets the degree of what follows, at most the one constructed for.
  virtual void set_degree(int degree, const Execution& execution) = 0;
  virtual Eigen::VectorXd multiply(const Eigen::VectorXd& coefficients,
                                   const Execution& execution) const = 0;
  /// sum w_i values_i Y(u_i).
  virtual Eigen::VectorXd project(const std::vector<double>& values,
                                  const Execution& execution) const = 0;
  /// The series at the points.
  virtual std::vector<double> evaluate(const Eigen::VectorXd& coefficients,
                                       const Execution& execution) const = 0;
  /// Passes of residual correction that make the solution that of plain least squares.
  virtual int passes() const = 0;
};

/// The equations for degrees up to `degree`; set_degree comes first. From about two thousand points
/// on they are formed from moments gathered on a grid, in time linear in the points. The points
/// must live as long.
std::unique_ptr<HarmonicEquations> harmonic_equations(const WeightedDirections& points, int degree,
                                                      const Execution& execution);

/// Estimate of the condition of the equations at the degree they are set to; infinite when they
/// have no unique solution.
double condition_of(const HarmonicEquations& equations, int degree, const Execution& execution);

/// Points a coefficient needs at least, and the largest condition of the normal equations: beyond
/// either the series swings between the points.
inline constexpr std::size_t points_per_coefficient = 2;
inline constexpr double largest_condition = 1000.0;

/// Least squares for values_i at the degree the equations are set to, and the weighted rms
/// residual.
struct HarmonicLeastSquares {
  std::vector<double> coefficients;
  double residual = 0.0;
  bool converged = true;
};

HarmonicLeastSquares least_squares(const HarmonicEquations& equations,
                                   const WeightedDirections& points,
                                   const std::vector<double>& values, int degree,
                                   const Execution& execution);

}  // namespace wscvt
