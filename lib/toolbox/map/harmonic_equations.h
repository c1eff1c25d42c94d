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

/// Returns sum w_i values_i / 4 pi.
double weighted_mean(const WeightedDirections& points, const std::vector<double>& values,
                     const Execution& execution);

/// The weighted normal equations A a = b of a fit, A = sum w_i Y(u_i) Y(u_i)^T, which is near the
/// identity if the points cover the sphere.
class HarmonicEquations {
 public:
  virtual ~HarmonicEquations() = default;

  /// Sets the degree for the following calls, at most the degree of the constructor.
  virtual void set_degree(int degree, const Execution& execution) = 0;
  virtual Eigen::VectorXd multiply(const Eigen::VectorXd& coefficients,
                                   const Execution& execution) const = 0;
  /// Returns sum w_i values_i Y(u_i).
  virtual Eigen::VectorXd project(const std::vector<double>& values,
                                  const Execution& execution) const = 0;
  /// Returns the series at the points.
  virtual std::vector<double> evaluate(const Eigen::VectorXd& coefficients,
                                       const Execution& execution) const = 0;
  /// Returns the number of passes of residual correction that give the solution of plain least
  /// squares.
  virtual int passes() const = 0;
};

/// Returns the equations for degrees up to `degree`. Call set_degree first. For more than about two
/// thousand points, moments on a grid form the equations, in time linear in the points. The points
/// must outlive the equations.
std::unique_ptr<HarmonicEquations> harmonic_equations(const WeightedDirections& points, int degree,
                                                      const Execution& execution);

/// Estimates the condition of the equations at their present degree; infinite if they have no
/// unique solution.
double condition_of(const HarmonicEquations& equations, int degree, const Execution& execution);

/// Minimum number of points per coefficient, and the largest condition of the normal equations.
/// Beyond either limit the series oscillates between the points.
inline constexpr std::size_t points_per_coefficient = 2;
inline constexpr double largest_condition = 1000.0;

/// The least-squares solution for values_i at the equations' degree.
struct HarmonicLeastSquares {
  std::vector<double> coefficients;
  bool converged = true;
};

HarmonicLeastSquares least_squares(const HarmonicEquations& equations,
                                   const WeightedDirections& points,
                                   const std::vector<double>& values, int degree,
                                   const Execution& execution);

}  // namespace wscvt
