// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {

namespace {

/// Up to this many points the basis is stored; above, the points are spread to a grid.
constexpr std::size_t maximum_stored_points = 2000;

/// Points a coefficient needs at least, and the largest condition of the normal equations: beyond
/// either the series swings between the points.
constexpr std::size_t points_per_coefficient = 2;
constexpr double largest_condition = 1000.0;

/// Grid rows per degree, and points of its interpolation along each angle. With 8 rows the moments
/// of the weights err by at most 1e-3 at the top, which the second pass of the fit squares.
constexpr int rows_per_degree = 8;
constexpr int fit_stencil = 6;
constexpr int smallest_grid = 32;

constexpr std::size_t point_block = 1024;

using Vector = Eigen::VectorXd;

Vector to_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::vector<double> to_array(const Vector& values) {
  return {values.data(), values.data() + values.size()};
}

Eigen::Index unknowns(int degree) { return static_cast<Eigen::Index>(harmonic_count(degree)); }

/// The samples, their weights scaled to sum to 4 pi.
struct Samples {
  const std::vector<Vector3>& directions;
  const std::vector<double>& radii;
  std::vector<double> weights;
};

/// The weighted normal equations A a = b of a fit, A = sum w_i Y(u_i) Y(u_i)^T, which is near the
/// identity when the points cover the sphere.
class NormalEquations {
 public:
  virtual ~NormalEquations() = default;

  /// Sets the degree of what follows, at most the one constructed for.
  virtual void set_degree(int degree, const Execution& execution) = 0;
  virtual Vector multiply(const Vector& coefficients, const Execution& execution) const = 0;
  /// sum w_i values_i Y(u_i).
  virtual Vector project(const std::vector<double>& values, const Execution& execution) const = 0;
  /// The series at the points.
  virtual std::vector<double> evaluate(const Vector& coefficients,
                                       const Execution& execution) const = 0;
  /// Passes of residual correction that make the solution that of plain least squares.
  virtual int passes() const = 0;
};

/// Few points: the basis at each is stored.
class StoredBasis : public NormalEquations {
 public:
  StoredBasis(const Samples& samples, int degree)
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

/// Many points: A depends on them only through the moments of the weights up to twice the degree.
/// The points are spread to a grid that keeps these, and A is applied as a product on the smallest
/// Gauss-Legendre grid that integrates it: multiply by the weight density of the same moments.
class SpreadMoments : public NormalEquations {
 public:
  SpreadMoments(const Samples& samples, int degree, const Execution& execution)
      : samples_(samples),
        rows_(std::max(smallest_grid, rows_per_degree * degree)),
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
    execution.parallel_for(values.size(), point_block, [&](std::size_t begin, std::size_t end) {
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

  const Samples& samples_;
  int rows_;
  std::vector<double> weight_moments_;
  std::unique_ptr<HarmonicTransform> on_points_grid_;
  std::unique_ptr<HarmonicTransform> on_quadrature_;
  std::vector<double> density_;  ///< with the quadrature's weights
};

/// What conjugate gradients found.
struct Solution {
  Vector unknowns;
  double condition = 0.0;  ///< ratio of the extreme Ritz values
  bool converged = false;
};

/// Conjugate gradients (Hestenes and Stiefel 1952) to `tolerance` relative to the right-hand side;
/// the eigenvalues of the Lanczos matrix they build estimate those of the equations.
Solution solve(const NormalEquations& equations, const Vector& right, double tolerance,
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

/// A right-hand side in which every eigenvector has its part, so that the condition shows even
/// where the data are a perfect sphere.
Vector probe(Eigen::Index size) {
  const std::vector<Vector3> random = random_directions(static_cast<int>(size), 1);
  Vector result(size);
  for (Eigen::Index i = 0; i < size; ++i) result[i] = random[static_cast<std::size_t>(i)].x();
  return result;
}

Samples check_samples(const std::vector<Vector3>& directions, const std::vector<double>& radii,
                      const std::vector<double>& weights, int degree) {
  require_in_range(degree, fit_degree_option);
  if (directions.empty()) {
    throw Error(ErrorCode::InvalidInput, "There are no points to fit a series to; give a mesh.");
  }
  if (radii.size() != directions.size() || weights.size() != directions.size()) {
    throw Error(ErrorCode::InvalidInput,
                "A fit needs a radius and a weight for every direction; there are " +
                    std::to_string(directions.size()) + " directions, " +
                    std::to_string(radii.size()) + " radii and " + std::to_string(weights.size()) +
                    " weights.");
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double off_unit = std::abs(directions[i].squaredNorm() - 1.0);
    // Written so that a NaN fails.
    const bool good = off_unit < 1e-9 && radii[i] > 0.0 && std::isfinite(radii[i]) &&
                      weights[i] > 0.0 && std::isfinite(weights[i]);
    if (!good) {
      throw Error(ErrorCode::InvalidInput,
                  "Point " + std::to_string(i) +
                      " of the fit is not usable: its direction must be a unit vector, its radius "
                      "and weight positive and finite.");
    }
    sum += weights[i];
  }
  Samples samples{directions, radii, weights};
  for (double& weight : samples.weights) weight *= 4.0 * pi / sum;
  return samples;
}

double weighted_mean(const Samples& samples, const std::vector<double>& values,
                     const Execution& execution) {
  return execution.parallel_sum(values.size(), point_block, 0.0,
                                [&](std::size_t begin, std::size_t end) {
                                  double part = 0.0;
                                  for (std::size_t i = begin; i < end; ++i) {
                                    part += samples.weights[i] * values[i];
                                  }
                                  return part;
                                }) /
         (4.0 * pi);
}

/// Least squares for r_i at the degree the equations are set to, and the weighted rms residual.
struct LeastSquares {
  Vector coefficients;
  double residual = 0.0;
  bool converged = true;
};

LeastSquares least_squares(const NormalEquations& equations, const Samples& samples, int degree,
                           const Execution& execution) {
  constexpr double tolerance = 1e-13;
  const double mean = weighted_mean(samples, samples.radii, execution);
  LeastSquares result;
  result.coefficients = Vector::Zero(unknowns(degree));
  result.coefficients[0] = mean * std::sqrt(4.0 * pi);
  std::vector<double> rest(samples.radii.size());
  const auto update_rest = [&](const std::vector<double>& series) {
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = samples.radii[i] - series[i];
  };
  update_rest(std::vector<double>(rest.size(), mean));
  for (int pass = 0; pass < equations.passes(); ++pass) {
    const Vector right = equations.project(rest, execution);
    const Solution solution = solve(equations, right, tolerance, execution);
    result.converged = result.converged && solution.converged;
    result.coefficients += solution.unknowns;
    update_rest(equations.evaluate(result.coefficients, execution));
  }
  for (double& value : rest) value *= value;
  result.residual = std::sqrt(weighted_mean(samples, rest, execution));
  return result;
}

}  // namespace

HarmonicSurface::HarmonicSurface(std::vector<double> coefficients)
    : coefficients_(std::move(coefficients)), series_(coefficients_) {
  for (std::size_t k = 0; k < coefficients_.size(); ++k) {
    if (!std::isfinite(coefficients_[k])) {
      throw Error(ErrorCode::InvalidInput, "Coefficient " + std::to_string(k) +
                                               " of the spherical-harmonic series is not a finite "
                                               "number.");
    }
  }
}

void HarmonicSurface::evaluate(const Vector3* directions, std::size_t count,
                               Derivatives derivatives, RadialJet* jets) const {
  series_.sum(directions, count, derivatives, jets);
}

void HarmonicSurface::evaluate_radii(const Vector3* directions, std::size_t count,
                                     double* radii) const {
  series_.sum(directions, count, radii);
}

double smallest_radius(const HarmonicSurface& surface, const Execution& execution) {
  const int rows = std::max(smallest_grid, rows_per_degree * surface.degree());
  const HarmonicTransform transform(surface.degree(), SphereGrid::row_cosines(rows),
                                    SphereGrid::row_sines(rows), 2 * rows, execution);
  const std::vector<double> radii = transform.synthesize(surface.coefficients(), execution);
  return *std::min_element(radii.begin(), radii.end());
}

HarmonicFit fit_harmonics(const std::vector<Vector3>& directions, const std::vector<double>& radii,
                          const std::vector<double>& weights, int degree,
                          const Execution& execution) {
  const Samples samples = check_samples(directions, radii, weights, degree);
  HarmonicFitReport report;
  report.requested_degree = degree;
  report.points = directions.size();

  int trial = degree;
  while (trial > 0 && points_per_coefficient * harmonic_count(trial) > directions.size()) --trial;
  DegreeLimit limit = trial < degree ? DegreeLimit::Points : DegreeLimit::None;

  std::unique_ptr<NormalEquations> equations;
  if (directions.size() <= maximum_stored_points) {
    equations = std::make_unique<StoredBasis>(samples, trial);
  } else {
    equations = std::make_unique<SpreadMoments>(samples, trial, execution);
  }
  execution.report(0.3, "Fitting spherical harmonics");

  for (; trial >= 0; trial -= std::max(1, trial / 8)) {
    equations->set_degree(trial, execution);
    const Solution probed = solve(*equations, probe(unknowns(trial)), 1e-4, execution);
    if (!probed.converged || probed.condition > largest_condition) {
      limit = DegreeLimit::Condition;
      continue;
    }
    const LeastSquares fit = least_squares(*equations, samples, trial, execution);
    if (!fit.converged) {
      limit = DegreeLimit::Condition;
      continue;
    }
    HarmonicSurface surface(to_array(fit.coefficients));
    const double smallest = smallest_radius(surface, execution);
    if (!(smallest > 0.0)) {
      limit = DegreeLimit::Radius;
      continue;
    }
    report.degree = trial;
    report.limit = limit;
    report.residual = fit.residual;
    report.condition = probed.condition;
    report.smallest_radius = smallest;
    execution.report(1.0, "Fitting spherical harmonics");
    return {std::move(surface), report};
  }
  throw Error(ErrorCode::NumericalFailure,
              "No spherical-harmonic series of degree " + std::to_string(degree) +
                  " or lower describes the surface with a positive radius everywhere; check that "
                  "the mesh is closed around its centre.");
}

void scale(HarmonicFitReport& report, double unit) {
  report.residual *= unit;
  report.smallest_radius *= unit;
}

}  // namespace wscvt
