// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toolbox/exchange/rockable_shape.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/execution.h"
#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Throws Error(InvalidInput) for a name without an ending of a table of nodes: .csv, .vtp or, in
/// the principal frame only, .shp.
void check_nodes_path(const std::string& path, const SimulationOptions& options);

/// Throws Error(InvalidInput) for a name without an ending of a grid: .npy, .vti or .json.
void check_grid_path(const std::string& path);

/// Returns the name of the description beside a grid: the grid's name and ".json" for a .npy, which
/// cannot contain it; empty for the others.
std::string grid_description_path(const std::string& path);

/// Throws Error(InvalidInput), naming the option, if the grid would be too large for this scan. Is
/// called before remesh, and repairs the scan as remesh does. Does not report faults of the scan;
/// remesh reports them.
void check_grid_of(IndexedMesh scan, const RemeshOptions& remesh, const SimulationOptions& options,
                   const Execution& execution);

/// Writes the nodes of a remesh in the chosen frame by nodes_csv, nodes_vtp or rockable_shape, by
/// the name's ending. Returns the rounding of a Rockable shape. Throws Error as check_nodes_path
/// and write_file do.
Rounding write_nodes(const std::string& path, const RemeshResult& result,
                     const SimulationOptions& options);

/// Writes signed distances in the chosen frame, by the name's ending: grid_npy with a description
/// beside it (frame, origin, spacing, mass properties of the scan at unit density in this frame),
/// grid_vti or grid_netdem. The scan is the result's repaired_scan. Throws Error as
/// check_grid_path, distance_grid and write_file do, and InvalidInput if the scan is needed but
/// missing: the result is of a formula, or made without `measures.repaired_scan`.
void write_distance_grid(const std::string& path, const RemeshResult& result,
                         const SimulationOptions& options, const ReportOrigin& origin,
                         const Execution& execution);

}  // namespace wscvt
