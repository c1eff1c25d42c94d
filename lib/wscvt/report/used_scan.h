// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/remesh_options.h"

namespace wscvt {

/// The scan as a remesh with these options uses it: with a surface where it is points, by its
/// envelope where one is asked for, checked and mended, in its own coordinates; with its handles.
/// Nothing for a scan without points, which a surface from a formula has. Throws Error as
/// check_mesh does.
IndexedMesh used_scan(IndexedMesh scan, const RemeshOptions& options, const Execution& execution);

}  // namespace wscvt
