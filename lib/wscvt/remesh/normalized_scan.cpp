// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/normalized_scan.h"

#include <utility>

namespace wscvt {

NormalizedScan normalize(IndexedMesh mesh, const Vector3& centre, double unit,
                         const Execution& execution) {
  constexpr std::size_t block = 1024;
  NormalizedScan scan;
  scan.unit = unit;
  scan.centre = centre;
  scan.mesh = std::move(mesh);
  std::vector<Vector3>& points = scan.mesh.points;
  execution.parallel_for(points.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) points[i] = (points[i] - centre) / unit;
  });
  execution.report(0.0, "Measuring the scan");
  scan.shape = describe_shape(scan.mesh, execution);
  scan.quality = measure_quality(scan.mesh, execution);
  return scan;
}

}  // namespace wscvt
