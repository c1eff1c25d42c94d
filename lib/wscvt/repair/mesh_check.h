// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/repair/scan_options.h"

namespace wscvt {

/// Makes one closed outer surface of a scan by these repairs. The report counts each repair:
/// - faces without a finite position are dropped, equal points are welded (see weld.h), degenerate,
///   doubled and back-to-back faces are dropped (see repair_steps.h);
/// - the part with the largest volume is kept; parts are connected through edges. Other parts
///   inside it are pores or inclusions, parts outside are other bodies;
/// - if more than two faces meet in an edge, flaps and internal walls are dropped and sheets
///   separated (see repair_steps.h); the largest separated part is kept;
/// - faces are turned outward and holes are filled (see repair_steps.h);
/// - if fans of faces touch only in one vertex, each fan gets its own vertex.
/// A clean scan does not change. Voxel steps are reported and stay.
///
/// Throws Error(InvalidInput), with advice, if the mesh is empty, has indices out of range, has a
/// size not between 1e-60 and 1e60, is not orientable, encloses no volume, has parts of comparable
/// volume, or needs repairs of more area than the limit; also if an option is out of range.
CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution);

/// Writes the measures of a closed, outward mesh into the report: sliver faces, vertices, faces,
/// genus, volume, area, centroid and equivalent radius. Throws Error(InvalidInput) if it encloses
/// no volume.
void measure_closed(const IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report);

}  // namespace wscvt
