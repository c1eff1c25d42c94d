// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/surface/harmonic_equations.h"
#include "wscvt/surface/harmonic_transform.h"

namespace wscvt {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Rows of the grid on which a series is looked at, for each degree, and at least.
constexpr int rows_per_degree = 8;
constexpr int smallest_grid = 32;

/// The samples, their weights scaled to sum to 4 pi.
WeightedDirections check_samples(const std::vector<Vector3>& directions,
                                 const std::vector<double>& radii,
                                 const std::vector<double>& weights, int degree) {
  if (degree < 0 || degree > maximum_fit_degree) {
    throw Error(ErrorCode::InvalidInput, "The degree of the fit is " + std::to_string(degree) +
                                             "; give one from 0 to " +
                                             std::to_string(maximum_fit_degree) + ".");
  }
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
  WeightedDirections samples{directions, weights};
  for (double& weight : samples.weights) weight *= 4.0 * pi / sum;
  return samples;
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
  const WeightedDirections samples = check_samples(directions, radii, weights, degree);
  HarmonicFitReport report;
  report.requested_degree = degree;
  report.points = directions.size();

  int trial = degree;
  while (trial > 0 && points_per_coefficient * harmonic_count(trial) > directions.size()) --trial;
  DegreeLimit limit = trial < degree ? DegreeLimit::Points : DegreeLimit::None;

  const std::unique_ptr<HarmonicEquations> equations =
      harmonic_equations(samples, trial, execution);
  execution.report(0.3, "Fitting spherical harmonics");

  for (; trial >= 0; trial -= std::max(1, trial / 8)) {
    equations->set_degree(trial, execution);
    const double condition = condition_of(*equations, trial, execution);
    if (!(condition <= largest_condition)) {
      limit = DegreeLimit::Condition;
      continue;
    }
    HarmonicLeastSquares fit = least_squares(*equations, samples, radii, trial, execution);
    if (!fit.converged) {
      limit = DegreeLimit::Condition;
      continue;
    }
    HarmonicSurface surface(std::move(fit.coefficients));
    const double smallest = smallest_radius(surface, execution);
    if (!(smallest > 0.0)) {
      limit = DegreeLimit::Radius;
      continue;
    }
    report.degree = trial;
    report.limit = limit;
    report.residual = fit.residual;
    report.condition = condition;
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
