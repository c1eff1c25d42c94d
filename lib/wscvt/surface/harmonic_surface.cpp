// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

HarmonicSurface::HarmonicSurface(std::vector<double> coefficients)
    : coefficients_(std::move(coefficients)), series_(coefficients_) {
  for (std::size_t k = 0; k < coefficients_.size(); ++k) {
    if (!std::isfinite(coefficients_[k])) {
      refuse("Coefficient " + std::to_string(k) +
             " of the spherical-harmonic series is not a finite number.");
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

HarmonicMap::HarmonicMap(std::array<std::vector<double>, 3> coefficients)
    : coefficients_(std::move(coefficients)),
      series_{HarmonicSeries(coefficients_[0]), HarmonicSeries(coefficients_[1]),
              HarmonicSeries(coefficients_[2])} {
  constexpr std::array<char, 3> names{'x', 'y', 'z'};
  for (std::size_t k = 0; k < 3; ++k) {
    if (coefficients_[k].size() != coefficients_[0].size()) {
      refuse("The series for x, y and z have " + std::to_string(coefficients_[0].size()) + ", " +
             std::to_string(coefficients_[1].size()) + " and " +
             std::to_string(coefficients_[2].size()) + " coefficients. Give them the same degree.");
    }
    for (std::size_t i = 0; i < coefficients_[k].size(); ++i) {
      if (!std::isfinite(coefficients_[k][i])) {
        refuse("Coefficient " + std::to_string(i) + " of the series for " + names[k] +
               " is not a finite number.");
      }
    }
  }
}

std::vector<Vector3> HarmonicMap::positions(const std::vector<Vector3>& directions,
                                            const Execution& execution) const {
  constexpr std::size_t block = 1024;
  std::vector<Vector3> result(directions.size());
  execution.parallel_for(directions.size(), block, [&](std::size_t begin, std::size_t end) {
    std::vector<double> coordinate(end - begin);
    for (std::size_t k = 0; k < 3; ++k) {
      series_[k].sum(directions.data() + begin, coordinate.size(), coordinate.data());
      for (std::size_t i = begin; i < end; ++i) {
        result[i][static_cast<Eigen::Index>(k)] = coordinate[i - begin];
      }
    }
  });
  return result;
}

IndexedMesh mesh_of_surface(const HarmonicMap& map, int frequency, const Execution& execution) {
  IndexedMesh mesh = subdivided_sphere(frequency);
  mesh.points = map.positions(mesh.points, execution);
  return mesh;
}

}  // namespace wscvt
