// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/exchange/simulation_options.h"
#include "toolbox/job/grain_job.h"
#include "toolbox/report/sample_summary.h"
#include "toolbox/report/shape_table.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// A remesh of each grain, or one for each number of nodes.
struct RemeshJob {
  RemeshOptions remesh;
  /// Several numbers of nodes, ascending; remesh.node_count is then the largest. Each has a folder,
  /// such as n100, which is a sample of its own. Empty for one number.
  std::vector<int> levels;
  ShapeMeasures shapes;        ///< of shape.csv
  std::string format = "ply";  ///< ending of the meshes
  /// Of inputs that are volumes. choice.voxel_size, if it is a cube, is also that of the scans that
  /// are meshes.
  VolumeOptions volume;

  /// Frame and size of the meshes and of the files below.
  SimulationOptions simulation;
  std::vector<std::string> node_tables;  ///< endings of the tables of nodes, in node-table/
  std::vector<std::string> grids;        ///< endings of the signed distances, in sdf/
};

/// Throws Error(InvalidInput) for options that are out of range or do not go together, except those
/// of volumes, see check_volume_options.
void check_job(const RemeshJob& job);

/// Returns the job. Each file of a grain has the bytes that remesh, write_mesh, write_nodes and
/// write_distance_grid give for the grain alone. The tables are grains.csv; shape.csv if shapes are
/// described; and mass.csv if a frame, a size or a file for a simulation is chosen: volume,
/// centroid and inertia of each scan in that frame and size, at unit density.
GrainJob make_job(const RemeshJob& options, const std::string& folder, const Shard& shard = {});

/// Writes summary.json and summary.html, the page of its sample (see sample_html), beside each
/// grains.csv of a job that is done. Returns lines for a log. Does nothing for a part of a sample.
std::vector<std::string> write_summaries(const GrainJob& job, const Execution& execution);

}  // namespace wscvt
