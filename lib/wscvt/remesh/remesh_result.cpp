// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/remesh_result.h"

#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

double error_percent(const RemeshResult& result, ErrorMeasure measure) {
  switch (measure) {
    case ErrorMeasure::Volume:
      return std::abs(relative_error_percent(result.remesh.volume, result.scan.volume));
    case ErrorMeasure::Area:
      return std::abs(relative_error_percent(result.remesh.area, result.scan.area));
    case ErrorMeasure::Sphericity:
      return std::abs(relative_error_percent(result.remesh.sphericity, result.scan.sphericity));
    case ErrorMeasure::Inertia:
      return inertia_error_percent(result.remesh, result.scan);
    case ErrorMeasure::Distance:
      break;
  }
  if (!result.distances) {
    refuse("The result has no distances. Request them in the options of the remesh.");
  }
  return 100.0 * result.distances->root_mean_square / equivalent_radius(result.scan.volume);
}

void write_coefficients(const std::string& path, const RemeshResult& result) {
  const SeriesCoefficients& coefficients = result.coefficients;
  const bool of_shtools = ending_of(path) == ".sh";
  if (!coefficients.radius.empty() && of_shtools) {
    write_shtools(path, HarmonicSurface(coefficients.radius));
  } else if (!coefficients.radius.empty()) {
    write_harmonics(path, HarmonicSurface(coefficients.radius));
  } else if (!coefficients.map[0].empty() && of_shtools) {
    refuse(
        "A .sh file stores the coefficients of a radius, but these are of x, y and z. Write "
        "them to a .json file.");
  } else if (!coefficients.map[0].empty()) {
    write_harmonic_map(path, HarmonicMap(coefficients.map));
  } else {
    refuse("The result has no coefficients. Request them before remeshing.");
  }
}

}  // namespace wscvt
