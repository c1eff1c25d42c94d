// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/remesh_units.h"

#include "wscvt/nodes/node_refinement.h"
#include "wscvt/surface/harmonic_fit.h"

namespace wscvt {

void to_input_units(const Grain& grain, RemeshResult& result) {
  const double unit = grain.unit;
  scale(result.fit, unit);
  for (double& coefficient : result.coefficients) coefficient *= unit;
  for (std::vector<double>& coordinate : result.map_coefficients) {
    for (double& coefficient : coordinate) coefficient *= unit;
  }
  result.misfit *= unit;
  scale(result.original, unit, grain.centre);
  scale(result.remesh, unit, grain.centre);
  scale(result.original_quality, unit);
  scale(result.quality, unit);
  scale(result.refinement, unit);
  result.space.fit.offset *= unit;
  if (result.distances) scale(*result.distances, unit);
  for (Vector3& point : result.mesh.points) point = grain.centre + unit * point;
  for (double& radius : result.radial_distances) radius *= unit;
  for (double& area : result.cell_areas) area *= unit * unit;
  for (double& curvature : result.curvatures) curvature /= unit;
  for (double& distance : result.vertex_distances) distance *= unit;
}

}  // namespace wscvt
