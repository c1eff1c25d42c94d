// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/scan_nodes.h"
#include "wscvt/remesh/remesh_method.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/repaired_scan.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// Cuts, keeps or refuses the handles of a repaired scan by the options; cut handles are closed in
/// `scan`. Throws Error: InvalidInput for handles that are to be refused, and as cut_handles,
/// Cancelled.
HandleReport treat_handles(CheckedMesh& scan, const OnScanOptions& options,
                           const Execution& execution);

/// The method on the scan, for any closed grain: nodes in centroidal Voronoi cells on the grain's
/// own surface (see ScanRemesher). It keeps the purpose of the paper's weights and the centroidal
/// cells, but needs no sphere, rays or series.
class ScanMethod : public RemeshMethod {
 public:
  /// For at most `most_nodes`; `scan` must outlive this. `surface`: if not null, the star-shaped
  /// surface, in the units of `scan`, of which the scan is a mesh; it must outlive this. Nodes on
  /// the surface are then moved along their rays from the mesh's flat faces to the surface itself.
  /// Throws Error: InvalidInput, NumericalFailure, Cancelled.
  ScanMethod(const NormalizedScan& scan, const RadialSurface* surface, const OnScanOptions& options,
             int most_nodes, bool with_curvatures, const Execution& execution);

  Nodes place(int node_count, const Execution& execution) const override;
  int enough_above(int node_count, const Execution& execution) const override {
    return remesher_.enough_above(node_count, execution);
  }

 private:
  const NormalizedScan& scan_;
  const RadialSurface* surface_;
  OnScanOptions options_;
  bool with_curvatures_;
  ScanRemesher remesher_;
};

}  // namespace wscvt
