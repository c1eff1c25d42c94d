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
  std::vector<double> cell_areas;  ///< see voronoi_areas; their sum is the mesh's area
  ScanNodesReport report;
};

struct ScanParts;

/// Remeshes a scan on its own triangles, without a map. The scan is coarsened to exactly N vertices
/// by Ward's clusters, equalized as a centroidal Voronoi tessellation of its surface, fitted to the
/// scan, given its volume, and checked for self-intersections.
///
/// Any genus: handles stay. Cut the small handles of scanner noise, with loops of less than about
/// three edges of the result, before (cut_handles of scan/handles.h): otherwise they cost angles
/// and may intersect. Thin bodies keep both sheets, because no step moves from one sheet to the
/// other.
class ScanRemesher {
 public:
  /// `normalized_scan`: closed, connected, oriented outward, a 2-manifold (check_mesh), of
  /// equivalent radius 1 about the origin; it must outlive this. Faces without area are allowed.
  /// Computes everything that does not depend on the number of nodes, for up to `most_nodes`. The
  /// result does not depend on `most_nodes`.
  ///
  /// Throws Error(InvalidInput) for options out of range, Error(Cancelled).
  ScanRemesher(const IndexedMesh& normalized_scan, const ScanNodesOptions& options, int most_nodes,
               const Execution& execution);

  /// Places exactly `node_count` nodes, 4 to `most_nodes`. The same bytes on any number of threads.
  /// Throws Error(InvalidInput) if a body with handles cannot be triangulated by so few; the
  /// message says how many were tried and are enough. Error(Cancelled).
  ScanNodes place(int node_count, const Execution& execution) const;

  /// Returns a number of nodes, up to three times `node_count`, with which no triangles intersect;
  /// 0 if all of the five that are tried leave pairs. Throws Error(Cancelled).
  int enough_above(int node_count, const Execution& execution) const;

 private:
  std::optional<ScanNodes> try_to_place(int node_count, const Execution& execution) const;
  ScanNodesOptions options_;
  std::shared_ptr<const ScanParts> parts_;
};

}  // namespace wscvt
