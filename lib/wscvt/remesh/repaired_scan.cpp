// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/repaired_scan.h"

#include <utility>

#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/repair/point_cloud.h"
#include "wscvt/repair/shrink_wrap.h"
#include "wscvt/surface/crossing_pairs.h"

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
  if (options.points || wraps) count_given(points, faces, different, report);
  return repaired;
}

}  // namespace wscvt
