// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/parts.h"

#include <utility>

#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_warnings.h"

namespace wscvt {

PartsResult make_parts(IndexedMesh scan, RemeshOptions remesh_options, const ConvexOptions& options,
                       const Execution& execution) {
  check_options(options);
  remesh_options.measures.repaired_scan = true;
  remesh_options.measures.suggestions = false;  // would not be shown
  RemeshResult remeshed = remesh(std::move(scan), remesh_options, execution.part(0.0, 0.3));
  PartsResult result;
  // The parts do not inherit the remesh's faults, because they are made of the scan.
  result.warnings = scan_warnings(remeshed);
  result.original = remeshed.original;
  result.grain = std::move(remeshed.repaired_scan);
  result.parts = convex_parts(remeshed.mesh, result.grain, options, execution.part(0.3, 0.9));
  result.measures = measure_parts(result.parts, result.grain, execution.part(0.9, 1.0));
  return result;
}

}  // namespace wscvt
