// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/used_scan.h"

#include <utility>

#include "wscvt/scan/mesh_check.h"
#include "wscvt/scan/point_cloud.h"

namespace wscvt {

IndexedMesh used_scan(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  if (options.points && !scan.points.empty())
    scan = mesh_of_points(std::move(scan.points), execution);
  if (scan.triangles.empty()) return scan;
  if (options.envelope.opening_percent > 0.0) scan = envelope_of(scan, options.envelope, execution);
  return check_mesh(std::move(scan), options.check, execution).mesh;
}

}  // namespace wscvt
