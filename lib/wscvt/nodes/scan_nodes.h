// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/nodes/scan_nodes_options.h"

namespace wscvt {

/// Nodes on a scan, as a closed, oriented 2-manifold of the scan's genus g: F = 2 N - 4 + 4 g.
struct ScanNodes {
  IndexedMesh mesh;
  std::vector<double> cell_areas;  ///< of each node's Voronoi cell on the mesh, in its order
  ScanNodesReport report;
};

/// Remeshes a scan on its own triangles, without a map: coarsened to exactly N vertices by Ward's
/// clusters, evened as a centroidal Voronoi tessellation of the scan's surface, fitted to the scan,
/// given its volume, and looked through for triangles that meet.
///
/// Any genus: handles stay. Those of the scanner's noise, shorter than about three edges of the
/// result, are to be cut before (cut_handles of scan/handles.h): kept, they cost angles and may
/// meet. Thin bodies keep both sheets, since nothing here ever changes from one to the other; of
/// them the nearest of three fits is taken, as rims come out by chance.
class ScanRemesher {
 public:
  /// `normalized_scan`: closed, connected, oriented outward, a 2-manifold (check_mesh), of
  /// equivalent radius 1 about the origin. Faces without area are allowed. What does not depend on
  /// the number of nodes is made here; nodes up to `most_nodes` are asked for later. The result
  /// does not depend on `most_nodes`.
  ///
  /// Throws Error(InvalidInput) for options out of range, Error(Cancelled).
  ScanRemesher(IndexedMesh normalized_scan, const ScanNodesOptions& options, int most_nodes,
               const Execution& execution);

  /// The same for other options, without the work of making it ready. Throws Error(InvalidInput)
  /// for options out of range.
  ScanRemesher with(const ScanNodesOptions& options) const;

  /// Exactly `node_count` nodes, 4 to `most_nodes`. The same bytes on any number of threads. Throws
  /// Error(InvalidInput) where a body with handles cannot be triangulated by so few; the sentence
  /// says how many were tried and are enough. Error(Cancelled).
  ScanNodes place(int node_count, const Execution& execution) const;

 private:
  struct Parts;
  std::optional<ScanNodes> try_to_place(int node_count, const Execution& execution) const;
  int enough_above(int node_count, const Execution& execution) const;
  ScanNodesOptions options_;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace wscvt
