// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/scan_options.h"

namespace wscvt {

/// Makes one closed outer surface of a scan, by these repairs, each counted in the report:
/// - faces without a finite position are dropped, equal points are welded (see weld.h), degenerate,
///   doubled and folded faces are dropped (see degenerate_faces.h);
/// - of the parts connected through edges the one of largest volume is kept. Of the others those
///   inside it are pores or inclusions, those outside are other bodies;
/// - where more than two faces meet in an edge, flaps and walls are dropped and sheets taken apart
///   (see manifold_edges.h); of what comes apart the largest is kept again;
/// - faces are turned outward and holes are filled (see holes.h);
/// - where fans of faces touch in one vertex only, each gets a vertex of its own.
/// A clean scan goes through unchanged. Voxel steps are noted, and stay.
///
/// Throws Error(InvalidInput) with what to do about it when the mesh is empty, has indices out of
/// range, is too large or too small to compute with (1e-60 to 1e60), is not orientable, encloses no
/// volume, falls into parts of comparable volume, or would need more of its area mended than the
/// limit; and when an option is out of range.
CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution);

/// Fills in what a report says of a closed, outward mesh: sliver faces, vertices, faces, genus,
/// volume, area, centroid and equivalent radius. Throws Error(InvalidInput) when it encloses no
/// volume.
void measure_closed(const IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report);

}  // namespace wscvt
