// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/harmonic_equations.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "wscvt/base/numbers.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {

namespace {

/// Up to this many points the basis is stored. More points are spread to a grid.
constexpr std::size_t maximum_stored_points = 2000;

/// Grid rows per degree, and interpolation points along each angle. With 8 rows the error of the
/// weights' moments is at most 1e-3 at the highest degree; the second pass of the fit squares it.
constexpr int moment_rows_per_degree = 8;
constexpr int fit_stencil = 6;
constexpr int smallest_moment_grid = 32;

constexpr std::size_t equation_block = 1024;

using Vector = Eigen::VectorXd;

Vector to_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), values.size());
}

std::vector<double> to_array(const Vector& values) {
  return {values.data(), values.data() + values.size()};
}

Eigen::Index unknowns(int degree) { return static_cast<Eigen::Index>(harmonic_count(degree)); }

/// For few points: stores the basis at each point.
class StoredBasis : public HarmonicEquations {
 public:
  StoredBasis(const WeightedDirections& samples, int degree)
      : basis_(harmonic_values(degree, samples.directions.data(), samples.directions.size())),
        weights_(to_vector(samples.weights)),
        width_(unknowns(degree)),
        used_(width_) {}

  void set_degree(int degree, const Execution& /*execution*/) override { used_ = unknowns(degree); }

  Vector multiply(const Vector& coefficients, const Execution& /*execution*/) const override {
    return rows().transpose() * weights_.cwiseProduct(rows() * coefficients);
  }
  Vector project(const std::vector<double>& values, const Execution& /*execution*/) const override {
    return rows().transpose() * weights_.cwiseProduct(to_vector(values));
  }
  std::vector<double> evaluate(const Vector& coefficients,
                               const Execution& /*execution*/) const override {
    return to_array(rows() * coefficients);
  }
  int passes() const override { return 1; }

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using RowsMap = Eigen::Map<const Rows, 0, Eigen::OuterStride<>>;
  /// A lower degree is a prefix of every row.
  RowsMap rows() const {
    return {basis_.data(), weights_.size(), used_, Eigen::OuterStride<>(width_)};
  }

  std::vector<double> basis_;
  Vector weights_;
  Eigen::Index width_;
  Eigen::Index used_;
};

/// For many points. A depends on them only through the moments of the weights up to twice the
/// degree. The points are spread to a grid that keeps these moments. A is applied on the smallest
/// Gauss-Legendre grid that integrates it, as a product with the weight density that has these
/// moments.
class SpreadMoments : public HarmonicEquations {
 public:
  SpreadMoments(const WeightedDirections& samples, int degree, const Execution& execution)
      : samples_(samples),
        rows_(std::max(smallest_moment_grid, moment_rows_per_degree * degree)),
        weight_moments_(moments_of_weights(degree, execution)) {}

  void set_degree(int degree, const Execution& execution) override {
    const std::vector<double> cosines = SphereGrid::row_cosines(rows_);
    const std::vector<double> sines = SphereGrid::row_sines(rows_);
    on_points_grid_ =
        std::make_unique<HarmonicTransform>(degree, cosines, sines, 2 * rows_, execution);

    const GaussLegendre nodes = gauss_legendre(2 * degree + 1);
    std::vector<double> node_sines;
    for (const double z : nodes.nodes) node_sines.push_back(std::sqrt((1.0 - z) * (1.0 + z)));
    const int azimuths = 4 * degree + 2;
    on_quadrature_ =
        std::make_unique<HarmonicTransform>(degree, nodes.nodes, node_sines, azimuths, execution);
    const HarmonicTransform doubled(2 * degree, nodes.nodes, node_sines, azimuths, execution);
    density_ = doubled.synthesize(
        {weight_moments_.begin(),
         weight_moments_.begin() + static_cast<std::ptrdiff_t>(harmonic_count(2 * degree))},
        execution);
    for (std::size_t i = 0; i < density_.size(); ++i) {
      density_[i] *= nodes.weights[i / static_cast<std::size_t>(azimuths)] * 2.0 * pi / azimuths;
    }
  }

  Vector multiply(const Vector& coefficients, const Execution& execution) const override {
    std::vector<double> values = on_quadrature_->synthesize(to_array(coefficients), execution);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= density_[i];
    return to_vector(on_quadrature_->analyze(values, execution));
  }

  Vector project(const std::vector<double>& values, const Execution& execution) const override {
    const SphereGrid grid = SphereGrid::spread(
        rows_, fit_stencil, samples_.directions,
        [&](std::size_t begin, std::size_t end, double* products) {
          for (std::size_t i = begin; i < end; ++i) {
            products[i - begin] = samples_.weights[i] * values[i];
          }
        },
        execution);
    return to_vector(on_points_grid_->analyze(grid.values(), execution));
  }

  std::vector<double> evaluate(const Vector& coefficients,
                               const Execution& execution) const override {
    const SphereGrid grid(rows_, fit_stencil,
                          on_points_grid_->synthesize(to_array(coefficients), execution));
    std::vector<double> values(samples_.directions.size());
    execution.parallel_for(values.size(), equation_block, [&](std::size_t begin, std::size_t end) {
      grid.interpolate(samples_.directions.data() + begin, end - begin, values.data() + begin);
    });
    return values;
  }

  int passes() const override { return 2; }

 private:
  std::vector<double> moments_of_weights(int degree, const Execution& execution) const {
    const SphereGrid grid = SphereGrid::spread(
        rows_, fit_stencil, samples_.directions,
        [&](std::size_t begin, std::size_t end, double* values) {
          std::copy(samples_.weights.begin() + static_cast<std::ptrdiff_t>(begin),
                    samples_.weights.begin() + static_cast<std::ptrdiff_t>(end), values);
        },
        execution);
    const HarmonicTransform transform(2 * degree, SphereGrid::row_cosines(rows_),
                                      SphereGrid::row_sines(rows_), 2 * rows_, execution);
    return transform.analyze(grid.values(), execution);
  }

  const WeightedDirections& samples_;
  int rows_;
  std::vector<double> weight_moments_;
  std::unique_ptr<HarmonicTransform> on_points_grid_;
  std::unique_ptr<HarmonicTransform> on_quadrature_;
  std::vector<double> density_;  ///< times the quadrature's weights
};

/// The result of conjugate gradients.
struct Solution {
  Vector unknowns;
  double condition = 0.0;  ///< ratio of the extreme Ritz values
  bool converged = false;
};

/// Solves by conjugate gradients (Hestenes and Stiefel 1952) to `tolerance` relative to the
/// right-hand side. The eigenvalues of their Lanczos matrix estimate the equations' eigenvalues.
Solution solve(const HarmonicEquations& equations, const Vector& right, double tolerance,
               const Execution& execution) {
  constexpr int maximum_iterations = 300;
  Solution solution;
  solution.unknowns = Vector::Zero(right.size());
  Vector residual = right;
  Vector direction = residual;
  double square = residual.squaredNorm();
  const double stop = tolerance * tolerance * square;
  solution.converged = square == 0.0;
  solution.condition = 1.0;
  std::vector<double> diagonal;
  std::vector<double> off_diagonal;
  double carried = 0.0;
  for (int i = 0; i < maximum_iterations && !solution.converged; ++i) {
    const Vector product = equations.multiply(direction, execution);
    const double curvature = direction.dot(product);
    if (!(curvature > 0.0)) {
      solution.condition = std::numeric_limits<double>::infinity();
      return solution;
    }
    const double step = square / curvature;
    solution.unknowns += step * direction;
    residual -= step * product;
    const double next = residual.squaredNorm();
    const double ratio = next / square;
    diagonal.push_back(1.0 / step + carried);
    off_diagonal.push_back(std::sqrt(ratio) / step);
    carried = ratio / step;
    direction = residual + ratio * direction;
    square = next;
    solution.converged = square <= stop;
  }
  if (!diagonal.empty()) {
    off_diagonal.pop_back();
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(to_vector(diagonal), to_vector(off_diagonal),
                                Eigen::EigenvaluesOnly);
    const double smallest = ritz.eigenvalues().minCoeff();
    solution.condition = smallest > 0.0 ? ritz.eigenvalues().maxCoeff() / smallest
                                        : std::numeric_limits<double>::infinity();
  }
  return solution;
}

/// Returns a right-hand side with a part of every eigenvector, so that the condition is found even
/// if the data are a perfect sphere.
Vector probe(Eigen::Index size) {
  const std::vector<Vector3> random = random_directions(static_cast<int>(size), 1);
  Vector result(size);
  for (Eigen::Index i = 0; i < size; ++i) result[i] = random[i].x();
  return result;
}

}  // namespace

std::unique_ptr<HarmonicEquations> harmonic_equations(const WeightedDirections& points, int degree,
                                                      const Execution& execution) {
  if (points.directions.size() <= maximum_stored_points) {
    return std::make_unique<StoredBasis>(points, degree);
  }
  return std::make_unique<SpreadMoments>(points, degree, execution);
}

double condition_of(const HarmonicEquations& equations, int degree, const Execution& execution) {
  const Solution probed = solve(equations, probe(unknowns(degree)), 1e-4, execution);
  return probed.converged ? probed.condition : std::numeric_limits<double>::infinity();
}

double weighted_mean(const WeightedDirections& points, const std::vector<double>& values,
                     const Execution& execution) {
  const double sum = execution.parallel_sum_of(
      values.size(), equation_block, 0.0,
      [&](std::size_t i, double& part) { part += points.weights[i] * values[i]; });
  return sum / (4.0 * pi);
}

HarmonicLeastSquares least_squares(const HarmonicEquations& equations,
                                   const WeightedDirections& points,
                                   const std::vector<double>& values, int degree,
                                   const Execution& execution) {
  constexpr double tolerance = 1e-13;
  const double mean = weighted_mean(points, values, execution);
  HarmonicLeastSquares result;
  Vector coefficients = Vector::Zero(unknowns(degree));
  coefficients[0] = mean * std::sqrt(4.0 * pi);
  std::vector<double> rest(values.size());
  for (int pass = 0; pass < equations.passes(); ++pass) {
    const std::vector<double> series = pass == 0 ? std::vector<double>(rest.size(), mean)
                                                 : equations.evaluate(coefficients, execution);
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = values[i] - series[i];
    const Vector right = equations.project(rest, execution);
    const Solution solution = solve(equations, right, tolerance, execution);
    result.converged = result.converged && solution.converged;
    coefficients += solution.unknowns;
  }
  result.coefficients = to_array(coefficients);
  return result;
}

}  // namespace wscvt
