// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// The nodes and their mesh, in the units of the NormalizedScan and about its origin, as are the
/// lengths in the report.
struct Nodes {
  IndexedMesh mesh;
  std::vector<double> cell_areas;  ///< see RemeshResult
  std::vector<double> curvatures;  ///< largest absolute principal curvature at the nodes; if asked
  std::variant<OnScanReport, AsPublishedReport> report;
};

/// One of the two methods, prepared for a grain.
class RemeshMethod {
 public:
  RemeshMethod() = default;
  RemeshMethod(const RemeshMethod&) = delete;
  RemeshMethod& operator=(const RemeshMethod&) = delete;
  virtual ~RemeshMethod() = default;

  /// Places `node_count` nodes. Called once, or many times by a search. Throws
  /// Error: InvalidInput, NumericalFailure, Cancelled.
  virtual Nodes place(int node_count, const Execution& execution) const = 0;

  /// Returns a larger number of nodes that was tried and whose triangles do not intersect; 0 if
  /// none was found, or if the method does not look for one. Throws Error(Cancelled).
  virtual int enough_above(int /*node_count*/, const Execution& /*execution*/) const { return 0; }
};

}  // namespace wscvt
