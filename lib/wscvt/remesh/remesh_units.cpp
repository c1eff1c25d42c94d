// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/remesh_units.h"

#include "wscvt/surface/harmonic_fit.h"

namespace wscvt {

void to_input_units(double unit, const Vector3& centre, RemeshResult& result) {
  if (auto* report = std::get_if<AsPublishedReport>(&result.method)) scale(report->fit, unit);
  if (auto* report = std::get_if<OnScanReport>(&result.method)) {
    report->nodes.volume_offset *= unit;
  }
  for (double& coefficient : result.coefficients.radius) coefficient *= unit;
  for (std::vector<double>& coordinate : result.coefficients.map) {
    for (double& coefficient : coordinate) coefficient *= unit;
  }
  result.rms_distance *= unit;
  result.largest_distance *= unit;
  scale(result.scan, unit, centre);
  scale(result.remesh, unit, centre);
  scale(result.scan_quality, unit);
  scale(result.quality, unit);
  if (result.distances) scale(*result.distances, unit);
  for (Vector3& point : result.mesh.points) point = centre + unit * point;
  for (double& radius : result.radial_distances) radius *= unit;
  for (double& area : result.cell_areas) area *= unit * unit;
  for (double& curvature : result.curvatures) curvature /= unit;
  for (double& distance : result.vertex_distances) distance *= unit;
}

}  // namespace wscvt
