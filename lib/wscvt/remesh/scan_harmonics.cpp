// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/scan_harmonics.h"

#include <utility>

#include "wscvt/repair/folded_solid_angle.h"
#include "wscvt/surface/harmonic_fit.h"
#include "wscvt/surface/harmonic_map.h"
#include "wscvt/surface/mapped_surface.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/sphere_map.h"

namespace wscvt {

SeriesCoefficients scan_harmonics(const IndexedMesh& scan, int degree, const Execution& execution) {
  SeriesCoefficients coefficients;
  const double overhang = folded_solid_angle(scan, Vector3::Zero(), execution);
  if (overhang == 0.0) {
    const MeshSurface rays(scan, Vector3::Zero(), 1.0, overhang, execution);
    coefficients.radius = fit_harmonics(rays, degree, execution).surface.coefficients();
    return coefficients;
  }
  SphereMap map = map_to_sphere(scan, execution.part(0.0, 0.8));
  const MappedSurface mapped(scan, std::move(map.directions), execution.part(0.8, 0.9));
  coefficients.map = fit_harmonic_map(mapped, degree, execution.part(0.9, 1.0)).map.coefficients();
  return coefficients;
}

}  // namespace wscvt
