// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/scan_harmonics.h"

#include <utility>

#include "toolbox/map/harmonic_map.h"
#include "toolbox/map/mapped_surface.h"
#include "toolbox/map/sphere_map.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

SeriesCoefficients scan_harmonics(const IndexedMesh& scan, int degree, const Execution& execution) {
  SeriesCoefficients coefficients = radial_coefficients(scan, degree, execution);
  if (!coefficients.radius.empty()) return coefficients;
  SphereMap map = map_to_sphere(scan, execution.part(0.0, 0.8));
  const MappedSurface mapped(scan, std::move(map.directions), execution.part(0.8, 0.9));
  coefficients.map = fit_harmonic_map(mapped, degree, execution.part(0.9, 1.0)).map.coefficients();
  return coefficients;
}

}  // namespace wscvt
