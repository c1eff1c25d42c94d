// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/repaired_scan.h"

#include <utility>

#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/new_surface.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/surface/harmonic_fit.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

RepairedScan repair_scan(IndexedMesh scan, const RemeshOptions& options,
                         const Execution& execution) {
  RepairedScan repaired;
  const std::size_t points = scan.points.size();
  const std::size_t faces = scan.triangles.size();
  const bool wraps = options.shrink_wrap.opening_percent > 0.0;
  if (wraps && options.points) {
    // The points themselves are wrapped, because a surface made by rays misses points behind
    // others.
    scan.triangles.clear();
  } else {
    scan = with_surface(std::move(scan), options.points, execution.part(0.0, 0.7));
  }
  const std::size_t different = scan.points.size();
  repaired.precision_warning = precision_warning(scan);
  if (wraps) scan = shrink_wrap_of(std::move(scan), options.shrink_wrap, execution.part(0.7, 0.85));
  MeshCheckOptions check;
  check.repaired_area_limit_percent = options.max_repaired_area_percent;
  repaired.checked =
      check_mesh(std::move(scan), check, execution.part(options.points || wraps ? 0.85 : 0.0, 1.0));
  repaired.crossing_warning = crossing_sentence(
      crossing_pairs(repaired.checked.mesh, execution.part(1.0, 1.0)), "the scan");
  MeshCheckReport& report = repaired.checked.report;
  if (options.points && !wraps) {
    repaired.steep_area_fraction =
        steep_area_fraction(repaired.checked.mesh, report.centroid, execution);
  }
  if (options.points || wraps) {  // the report is on the surface that was made
    report.input_vertices = points;
    report.input_faces = faces;
    report.welded_vertices = points - different;
  }
  return repaired;
}

NormalizedScan normalize(IndexedMesh mesh, const Vector3& centre, double unit,
                         const Execution& execution) {
  constexpr std::size_t block = 1024;
  NormalizedScan scan;
  scan.unit = unit;
  scan.centre = centre;
  scan.mesh = std::move(mesh);
  std::vector<Vector3>& points = scan.mesh.points;
  execution.parallel_for_each(points.size(), block,
                              [&](std::size_t i) { points[i] = (points[i] - centre) / unit; });
  execution.report(0.0, "Measuring the scan");
  scan.shape = describe_shape(scan.mesh, execution);
  scan.quality = measure_quality(scan.mesh, execution);
  return scan;
}

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
