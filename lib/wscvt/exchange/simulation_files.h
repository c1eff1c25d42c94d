// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/execution.h"
#include "wscvt/exchange/simulation_options.h"
#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Throws Error(InvalidInput) if a name does not have an ending of a node table: .csv, .vtp or
/// .shp. The ending .shp needs the principal frame.
void check_nodes_path(const std::string& path, const SimulationOptions& options);

/// Throws Error(InvalidInput) if a name does not have an ending of a grid: .npy, .vti or .json.
void check_grid_path(const std::string& path);

/// Returns the path of the description of a grid: the path and ".json" for a .npy, which cannot
/// contain a description; else empty.
std::string grid_description_path(const std::string& path);

/// Throws Error(InvalidInput), which names the option, if the grid is too large for this scan. For
/// this check, before the remesh, the scan is repaired as in remesh. Errors of the scan are left to
/// remesh.
void check_grid_of(IndexedMesh scan, const RemeshOptions& remesh, const SimulationOptions& options,
                   const Execution& execution);

/// Writes the nodes of a remesh in the frame of the options, by the name's ending: nodes_csv,
/// nodes_vtp or rockable_shape. Throws Error as check_nodes_path and write_file.
void write_nodes(const std::string& path, const RemeshResult& result,
                 const SimulationOptions& options);

/// Writes signed distances in the frame of the options, by the name's ending: grid_npy, grid_vti or
/// grid_netdem. Beside a grid_npy it writes a description: frame, origin, spacing, and mass
/// properties of the scan at unit density in that frame. The scan is the result's repaired_scan.
/// Throws Error as check_grid_path, distance_grid and write_file. Throws InvalidInput if the
/// options need the scan and the result has no scan: its surface is a formula, or
/// `measures.repaired_scan` was false.
void write_distance_grid(const std::string& path, const RemeshResult& result,
                         const SimulationOptions& options, const ReportOrigin& origin,
                         const Execution& execution);

}  // namespace wscvt
