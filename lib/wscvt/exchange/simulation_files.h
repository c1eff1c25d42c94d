// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "wscvt/base/execution.h"
#include "wscvt/base/option.h"
#include "wscvt/exchange/distance_grid.h"
#include "wscvt/exchange/simulation_frame.h"
#include "wscvt/report/remesh_result.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Whose surface the distances of a grid are to.
enum class GridSurface { Scan, Remesh };

template <>
struct EnumerationTable<GridSurface> {
  static constexpr std::string_view key = "sdf-surface";
  static constexpr std::string_view subject = "surface of the grid of distances";
  static constexpr Enumerator<GridSurface> rows[] = {
      {GridSurface::Scan, "scan", "the scan, as it was mended"},
      {GridSurface::Remesh, "remesh", "the remesh"},
  };
};

/// How a remesh and files of it are written for a simulation.
struct SimulationOptions {
  FrameOptions frame;
  GridSurface surface = GridSurface::Scan;
  GridOptions grid;
};

/// The unit options share a type, so each has its name beside it.
inline constexpr std::string_view input_unit_key = "input-unit";
inline constexpr std::string_view output_unit_key = "output-unit";

/// Throws Error(InvalidInput) for options out of range or at odds with each other.
void check_simulation_options(const SimulationOptions& options);

/// Throws Error(InvalidInput) for a name that does not end as a table of nodes does: .csv, .vtp or
/// .shp, the last in the principal frame only.
void check_nodes_path(const std::string& path, const SimulationOptions& options);

/// Throws Error(InvalidInput) for a name that does not end as a grid does: .npy, .vti or .json.
void check_grid_path(const std::string& path);

/// The description that goes beside a grid of that name: that name and ".json" for a .npy, which
/// has no place for it; empty for the others.
std::string grid_description_path(const std::string& path);

/// Writes the nodes of a remesh in the frame asked for, by the name's ending: nodes_csv, nodes_vtp
/// or rockable_shape. Throws Error as check_nodes_path and write_file do.
void write_nodes(const std::string& path, const RemeshResult& result,
                 const SimulationOptions& options);

/// Writes signed distances in the frame asked for, by the name's ending: grid_npy with a
/// description beside it (frame, origin, spacing, mass properties of the scan at unit density in
/// that frame), grid_vti or grid_netdem. The scan is the result's used_scan. Throws Error as
/// check_grid_path, distance_grid and write_file do, and InvalidInput where the scan is asked for
/// and the result holds none: it came from a formula, or without `measures.used_scan`.
void write_distance_grid(const std::string& path, const RemeshResult& result,
                         const SimulationOptions& options, const ReportOrigin& origin,
                         const Execution& execution);

}  // namespace wscvt
