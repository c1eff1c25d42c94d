// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/execution.h"
#include "wscvt/exchange/simulation_options.h"
#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Throws Error(InvalidInput) for a name that does not end as a table of nodes does: .csv, .vtp or
/// .shp, the last in the principal frame only.
void check_nodes_path(const std::string& path, const SimulationOptions& options);

/// Throws Error(InvalidInput) for a name that does not end as a grid does: .npy, .vti or .json.
void check_grid_path(const std::string& path);

/// The description that goes beside a grid of that name: that name and ".json" for a .npy, which
/// has no place for it; empty for the others.
std::string grid_description_path(const std::string& path);

/// Throws Error(InvalidInput), naming the option, where the grid asked for is too large for this
/// scan, before it is remeshed: it is mended for that as remesh does. What is wrong with the scan
/// is left to remesh to say.
void check_grid_of(IndexedMesh scan, const RemeshOptions& remesh, const SimulationOptions& options,
                   const Execution& execution);

/// Writes the nodes of a remesh in the frame asked for, by the name's ending: nodes_csv, nodes_vtp
/// or rockable_shape. Throws Error as check_nodes_path and write_file do.
void write_nodes(const std::string& path, const RemeshResult& result,
                 const SimulationOptions& options);

/// Writes signed distances in the frame asked for, by the name's ending: grid_npy with a
/// description beside it (frame, origin, spacing, mass properties of the scan at unit density in
/// that frame), grid_vti or grid_netdem. The scan is the result's repaired_scan. Throws Error as
/// check_grid_path, distance_grid and write_file do, and InvalidInput where the scan is asked for
/// and the result holds none: it came from a formula, or without `measures.repaired_scan`.
void write_distance_grid(const std::string& path, const RemeshResult& result,
                         const SimulationOptions& options, const ReportOrigin& origin,
                         const Execution& execution);

}  // namespace wscvt
