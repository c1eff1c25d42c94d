// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/repair/scan_options.h"

namespace wscvt {

/// Returns the number of handles of a closed, connected 2-manifold without unused vertices.
std::size_t genus_of(const IndexedMesh& mesh);

/// A mesh without the handles made by the scanner, and the report of the cuts.
struct HandleFreeMesh {
  IndexedMesh mesh;  ///< first the input's vertices (vertices of loops moved), then new vertices
  HandleReport report;
};

/// Cuts the handles of a closed, oriented, connected 2-manifold (check_mesh's result) whose loops
/// are not above the limit. The other handles stay. Cuts each handle along a short loop that does
/// not separate the surface, and caps both sides. If the loop runs round a bridge, this cuts the
/// bridge; if it runs round a tunnel, this closes the tunnel. The two caps coincide at first. Each
/// is faired towards the surface on its own side, so that they separate. The
/// shortest loop of the mesh is cut first, then the shortest of what is left, so that the order of
/// the faces does not matter. Loops come from tree-cotree decompositions (Eppstein 2003, "Dynamic
/// generators of topologically embedded graphs"; Erickson and Whittlesey 2005, "Greedy optimal
/// homotopy and homology generators"). On fine scans, where loops have more than about
/// 20 edges, one that is a little longer than the shortest may be taken. The report has the
/// shortest loop that stays. Returns a mesh of genus 0 unchanged.
///
/// Throws Error(InvalidInput) if an option is out of range, the mesh is not closed or it has more
/// than most_handles_cut handles; Error(Cancelled).
HandleFreeMesh remove_handles(IndexedMesh mesh, const HandleOptions& options,
                              const Execution& execution);

/// Cuts the handles of a checked scan and updates its report. Only the genus in the report remains
/// the scan's. Throws as remove_handles.
HandleReport cut_handles(CheckedMesh& scan, const HandleOptions& options,
                         const Execution& execution);

}  // namespace wscvt
