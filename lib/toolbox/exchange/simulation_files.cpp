// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/simulation_files.h"

#include <cmath>
#include <utility>

#include "toolbox/exchange/distance_grid.h"
#include "toolbox/exchange/node_table.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh/repaired_scan.h"
#include "wscvt/report/json.h"

namespace wscvt {

namespace {

std::string grid_description(const DistanceGrid& grid, const RemeshResult& result,
                             const SimulationFrame& frame, const SimulationOptions& options,
                             const ReportOrigin& origin) {
  const Eigen::Quaterniond& axes = frame.axes;
  return json_document(
      {{"format", "wscvt-grid"},
       {"version", 1},
       {"made_by", made_by()},
       {"source", told(origin.source)},
       {"date", told(origin.date)},
       {"surface", key_of(options.surface)},
       {"values", "signed distance, negative inside, [x][y][z]"},
       {"origin", json_of(grid.origin)},
       {"spacing", grid.spacing},
       {"counts", {{"x", grid.counts[0]}, {"y", grid.counts[1]}, {"z", grid.counts[2]}}},
       {"frame",
        {{"name", key_of(options.frame.frame)},
         {"origin_in_scan", json_of(frame.origin)},
         {"axes_in_scan", {{"w", axes.w()}, {"x", axes.x()}, {"y", axes.y()}, {"z", axes.z()}}},
         {"scale", frame.scale}}},
       {"mass", json_of(in_frame(mass_properties(result.scan), frame))}});
}

}  // namespace

void check_simulation_options(const SimulationOptions& options) {
  check_frame_options(options.frame);
  require_valid(options.surface);
  require_in_range(options.grid.spacing, grid_spacing_option);
}

void check_nodes_path(const std::string& path, const SimulationOptions& options) {
  const std::string ending = ending_of(path);
  if (ending == ".csv" || ending == ".vtp") return;
  if (ending != ".shp") {
    refuse("Unknown format of a node table: \"" + path + "\". Use .csv, .vtp or .shp (Rockable).");
  }
  if (options.frame.frame != Frame::Principal) {
    refuse("\"" + path +
           "\" is a Rockable shape. It must be in its principal axes: use the frame principal.");
  }
}

void check_grid_path(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".npy" || ending == ".vti" || ending == ".json") return;
  refuse("Unknown format of signed distances: \"" + path + "\". Use .npy, .vti or .json (NetDEM).");
}

std::string grid_description_path(const std::string& path) {
  return ending_of(path) == ".npy" ? path + ".json" : "";
}

void check_grid_of(IndexedMesh scan, const RemeshOptions& remesh, const SimulationOptions& options,
                   const Execution& execution) {
  if (options.grid.spacing == 0.0) return;
  try {
    scan = repair_scan(std::move(scan), remesh, execution).checked.mesh;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    return;
  }
  const SimulationFrame frame = simulation_frame(describe_shape(scan, execution), options.frame);
  check_grid(in_frame(std::move(scan), frame), options.grid);
}

Rounding write_nodes(const std::string& path, const RemeshResult& result,
                     const SimulationOptions& options) {
  check_nodes_path(path, options);
  const SimulationFrame frame = simulation_frame(result.scan, options.frame);
  IndexedMesh mesh = in_frame(result.mesh, frame);
  const std::string ending = ending_of(path);
  if (ending == ".shp") {
    return write_rockable_shape(path, mesh, in_frame(mass_properties(result.scan), frame));
  }
  const NodeTable nodes = node_table(std::move(mesh));
  write_file(path, ending == ".csv" ? nodes_csv(nodes) : nodes_vtp(nodes));
  return {};
}

void write_distance_grid(const std::string& path, const RemeshResult& result,
                         const SimulationOptions& options, const ReportOrigin& origin,
                         const Execution& execution) {
  check_grid_path(path);
  const SimulationFrame frame = simulation_frame(result.scan, options.frame);
  const IndexedMesh& surface =
      options.surface == GridSurface::Remesh ? result.mesh : result.repaired_scan;
  const DistanceGrid grid = distance_grid(in_frame(surface, frame), options.grid, execution);
  const std::string ending = ending_of(path);
  if (ending == ".vti") return write_file(path, grid_vti(grid));
  if (ending == ".json") return write_file(path, grid_netdem(grid));
  write_file(path, grid_npy(grid));
  write_file(grid_description_path(path), grid_description(grid, result, frame, options, origin));
}

void check_frame_options(const FrameOptions& options) {
  require_valid(options.frame);
  require_in_range(options.scale, scale_option);
  require_in_range(options.size, size_option);
  if (options.size > 0.0 && options.scale != 1.0) {
    refuse("There is an equivalent diameter of " + format_typed(options.size) +
           " and a scale factor of " + format_typed(options.scale) +
           ", but each of them sets the size. Give one of them.");
  }
}

SimulationFrame simulation_frame(const ShapeDescriptors& grain, const FrameOptions& options) {
  check_frame_options(options);
  SimulationFrame frame;
  frame.scale = options.scale;
  if (options.size > 0.0) frame.scale = options.size / portable::cbrt(6.0 * grain.volume / pi);
  if (options.frame != Frame::Input) frame.origin = grain.centroid;
  if (options.frame == Frame::Principal) frame.axes = grain.principal_axes;
  return frame;
}

IndexedMesh in_frame(IndexedMesh mesh, const SimulationFrame& frame) {
  for (Vector3& p : mesh.points) p = frame.point(p);
  return mesh;
}

MassProperties in_frame(const MassProperties& mass, const SimulationFrame& frame) {
  const double s = frame.scale;
  const Eigen::Matrix3d turn = frame.axes.toRotationMatrix();
  MassProperties result;
  result.volume = s * s * s * mass.volume;
  result.centroid = frame.point(mass.centroid);
  result.inertia_tensor = portable::pow(s, 5) * (turn.transpose() * mass.inertia_tensor * turn);
  result.principal_moments = portable::pow(s, 5) * mass.principal_moments;
  result.principal_axes = frame.axes.conjugate() * mass.principal_axes;
  return result;
}

}  // namespace wscvt
