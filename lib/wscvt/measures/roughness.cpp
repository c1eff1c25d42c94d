// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/roughness.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_fit.h"

namespace wscvt {

namespace {

/// Sq / mean radius below which heights are rounding errors.
constexpr double smallest_roughness = 1e-12;

}  // namespace

Roughness radial_roughness(const RadialSurface& surface, int degree, int polar_nodes,
                           const Execution& execution) {
  require_in_range(degree, fit_degree_option);
  if (degree >= polar_nodes) {
    throw Error(ErrorCode::InvalidInput,
                "The degree of the low-degree shape is " + std::to_string(degree) + " with " +
                    std::to_string(polar_nodes) + " polar nodes; give more nodes than the degree.");
  }
  const SphereQuadrature quadrature = gauss_legendre_sphere(polar_nodes);
  const std::vector<Vector3>& u = quadrature.directions;
  const std::vector<double> radii = surface.radii(u, execution);
  const HarmonicFit low = fit_harmonics(surface, degree, execution);
  const std::vector<RadialJet> jets = low.surface.jets(u, Derivatives::First, execution);

  // A few ten thousand terms: not worth threads.
  std::vector<double> heights(u.size());
  std::vector<double> areas(u.size());
  double area = 0.0;
  double mean = 0.0;
  double mean_radius = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    heights[i] = radii[i] - jets[i].radius;
    areas[i] = quadrature.weights[i] * area_element(jets[i]);
    area += areas[i];
    mean += areas[i] * heights[i];
    mean_radius += areas[i] * radii[i];
  }
  mean /= area;
  mean_radius /= area;

  Roughness result;
  result.degree = low.report.degree;
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double z = heights[i] - mean;
    const double share = areas[i] / area;
    result.sa += share * std::abs(z);
    second += share * z * z;
    third += share * z * z * z;
    fourth += share * z * z * z * z;
  }
  result.sq = std::sqrt(second);
  if (result.sq > smallest_roughness * mean_radius) {
    result.ssk = third / (second * result.sq);
    result.sku = fourth / (second * second);
  }
  return result;
}

double printed_sdq(const RadialSurface& surface, int rings, const Execution& execution) {
  if (rings < 1) {
    throw Error(ErrorCode::InvalidInput,
                "The number of parallels is " + std::to_string(rings) + "; give 1 or more.");
  }
  struct Sums {
    double slope = 0.0;
    double area = 0.0;
    Sums& operator+=(const Sums& other) {
      slope += other.slope;
      area += other.area;
      return *this;
    }
  };
  const auto count = static_cast<std::size_t>(rings);
  const double step = pi / rings;
  const Sums sums =
      execution.parallel_sum(count, 4, Sums(), [&](std::size_t begin, std::size_t end) {
        Sums part;
        std::vector<Vector3> directions(2 * count);
        std::vector<RadialJet> jets(2 * count);
        for (std::size_t ring = begin; ring < end; ++ring) {
          const double theta = (static_cast<double>(ring) + 0.5) * step;
          for (std::size_t k = 0; k < 2 * count; ++k) {
            const double phi = (static_cast<double>(k) + 0.5) * step;
            directions[k] = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                             std::cos(theta)};
          }
          surface.evaluate(directions.data(), directions.size(), Derivatives::First, jets.data());
          for (std::size_t k = 0; k < 2 * count; ++k) {
            const double phi = (static_cast<double>(k) + 0.5) * step;
            const Vector3 south(std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                                -std::sin(theta));
            const Vector3 east(-std::sin(phi), std::cos(phi), 0.0);
            const double r_theta = jets[k].gradient.dot(south);
            const double r_phi = std::sin(theta) * jets[k].gradient.dot(east);
            part.slope += r_theta * r_theta + r_phi * r_phi;
            part.area += std::sin(theta) * area_element(jets[k]);
          }
        }
        return part;
      });
  return std::sqrt(sums.slope / sums.area);
}

}  // namespace wscvt
