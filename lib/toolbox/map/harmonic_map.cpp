// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "toolbox/map/harmonic_equations.h"
#include "toolbox/map/mapped_surface.h"
#include "toolbox/map/scan_harmonics.h"
#include "toolbox/map/sphere_map.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

namespace {

/// Side length of the quadrature's triangles on the sphere times the degree. The midpoint rule's
/// error is about spacing^2 / 24 for the highest harmonics, one per cent.
constexpr double spacing_times_degree = 0.5;

/// Maximum number of quadrature points, unless there are more faces. Scans of a million vertices
/// have one point per face.
constexpr std::size_t quadrature_limit = 500000;

/// The centres of the pieces of the faces.
struct Quadrature {
  std::vector<Vector3> directions;
  std::array<std::vector<double>, 3> coordinates;
  std::vector<double> weights;  ///< areas
};

/// Returns the number of pieces along each side of the faces.
std::vector<std::int32_t> pieces_of(const MappedSurface& surface, int degree) {
  const std::vector<Triangle>& triangles = surface.mesh().triangles;
  const std::vector<Vector3>& u = surface.directions();
  std::vector<std::int32_t> pieces(triangles.size());
  for (double spacing = spacing_times_degree / std::max(1, degree);; spacing *= 2.0) {
    std::size_t total = 0;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const Triangle& t = triangles[f];
      const double longest = std::max(
          {(u[t[1]] - u[t[0]]).norm(), (u[t[2]] - u[t[1]]).norm(), (u[t[0]] - u[t[2]]).norm()});
      pieces[f] = std::max(1, static_cast<std::int32_t>(std::ceil(longest / spacing)));
      total += static_cast<std::size_t>(pieces[f]) * static_cast<std::size_t>(pieces[f]);
    }
    // Use a wider spacing if needle faces extend along the sphere, because their pieces grow with
    // the square.
    if (total <= std::max(quadrature_limit, triangles.size())) return pieces;
  }
}

Quadrature quadrature_over(const MappedSurface& surface, int degree) {
  const IndexedMesh& mesh = surface.mesh();
  const std::vector<std::int32_t> pieces = pieces_of(surface, degree);
  Quadrature result;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double area = triangle_area(mesh, mesh.triangles[f]);
    if (!(area > 0.0)) continue;
    const std::int32_t count = pieces[f];
    const auto add = [&](int i, int j, double shift) {
      MeshPlace place;
      place.triangle = static_cast<std::int32_t>(f);
      place.weights[0] = (i + shift) / count;
      place.weights[1] = (j + shift) / count;
      place.weights[2] = 1.0 - place.weights[0] - place.weights[1];
      const Vector3 x = surface.position(place);
      result.directions.push_back(surface.direction(place));
      for (std::size_t k = 0; k < 3; ++k) {
        result.coordinates[k].push_back(x[k]);
      }
      result.weights.push_back(area / (static_cast<double>(count) * count));
    };
    for (int i = 0; i < count; ++i) {
      for (int j = 0; i + j < count; ++j) {
        add(i, j, 1.0 / 3.0);
        if (i + j + 1 < count) add(i, j, 2.0 / 3.0);  // upside down
      }
    }
  }
  return result;
}

}  // namespace

HarmonicMap fit_harmonic_map(const MappedSurface& surface, int degree, const Execution& execution) {
  require_in_range(degree, fit_degree_option);
  execution.report(0.0, "Fitting the harmonic map");
  const Quadrature quadrature = quadrature_over(surface, degree);
  double area = 0.0;
  for (const double weight : quadrature.weights) area += weight;
  if (!(area > 0.0 && std::isfinite(area))) {
    refuse("The mapped surface has no area to fit a series to. Check the mesh first.");
  }
  WeightedDirections points{quadrature.directions, quadrature.weights};
  for (double& weight : points.weights) weight *= 4.0 * pi / area;

  int trial = degree;
  while (trial > 0 && points_per_coefficient * harmonic_count(trial) > points.directions.size())
    --trial;
  const std::unique_ptr<HarmonicEquations> equations = harmonic_equations(points, trial, execution);
  execution.report(0.4, "Fitting the harmonic map");
  for (; trial >= 0; trial -= std::max(1, trial / 8)) {
    equations->set_degree(trial, execution);
    bool converged = condition_of(*equations, trial, execution) <= largest_condition;
    std::array<std::vector<double>, 3> coefficients;
    for (std::size_t k = 0; k < 3 && converged; ++k) {
      HarmonicLeastSquares fit =
          least_squares(*equations, points, quadrature.coordinates[k], trial, execution);
      converged = fit.converged;
      coefficients[k] = std::move(fit.coefficients);
      execution.report(0.5 + 0.15 * static_cast<double>(k), "Fitting the harmonic map");
    }
    if (!converged) continue;
    execution.report(1.0, "Fitting the harmonic map");
    return HarmonicMap(std::move(coefficients));
  }
  throw Error(ErrorCode::NumericalFailure,
              "No series of spherical harmonics describes the mapped surface, not even of degree "
              "0. Check the mesh for faces without area.");
}

SeriesCoefficients scan_harmonics(const IndexedMesh& scan, int degree, const Execution& execution) {
  SeriesCoefficients coefficients = radial_coefficients(scan, degree, execution);
  if (!coefficients.radius.empty()) return coefficients;
  const MappedSurface mapped(scan, map_to_sphere(scan, execution.part(0.0, 0.8)),
                             execution.part(0.8, 0.9));
  coefficients.map = fit_harmonic_map(mapped, degree, execution.part(0.9, 1.0)).coefficients();
  return coefficients;
}

}  // namespace wscvt
