// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/scan_options.h"

namespace wscvt {

/// The number of handles of a closed, connected 2-manifold without vertices beside it.
std::size_t genus_of(const IndexedMesh& mesh);

/// A mesh without the handles that are the scanner's, and what was done to it.
struct HandleFreeMesh {
  IndexedMesh mesh;  ///< the input's vertices first, those of the rings moved; then new ones
  HandleReport report;
};

/// Cuts the handles of a closed, oriented, connected 2-manifold (check_mesh's result) whose loops
/// are not above the limit; the others stay. Each is cut along a short loop that does not separate
/// the surface, and both sides are capped: where the loop runs round a bridge the bridge is cut
/// through, where it runs round a tunnel the tunnel is closed. The caps lie on each other at first;
/// each is faired towards the surface on its own side, so that they part. Loops come from
/// tree-cotree decompositions (Eppstein 2003, "Dynamic generators of topologically embedded
/// graphs"; Erickson and Whittlesey 2005, "Greedy optimal homotopy and homology generators") about
/// the places where a first one finds handles, the shortest first; the report has the first that
/// stays. A mesh of genus 0 comes back as it is.
///
/// Throws Error(InvalidInput) when an option is out of range, the mesh is not closed or it has more
/// than most_handles_cut handles; Error(Cancelled).
HandleFreeMesh remove_handles(IndexedMesh mesh, const HandleOptions& options,
                              const Execution& execution);

/// The same for a checked scan, whose report then has the measures of what is left, but for the
/// genus, which stays that of the scan. Throws the same.
HandleReport cut_handles(CheckedMesh& scan, const HandleOptions& options,
                         const Execution& execution);

}  // namespace wscvt
