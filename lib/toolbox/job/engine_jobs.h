// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toolbox/clump/clump_options.h"
#include "toolbox/convex/convex_parts.h"
#include "toolbox/exchange/simulation_options.h"
#include "toolbox/job/grain_job.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// A clump of spheres of each grain.
struct ClumpJob {
  ClumpOptions clump;
  FrameOptions frame;
  double density = 1.0;        ///< of .molecule
  std::string format = "csv";  ///< ending of the clumps, see clump_files.h
};

/// Convex parts of each grain.
struct ConvexJob {
  ConvexJob() { remesh.node_count = convex_node_count; }

  ConvexOptions convex;
  RemeshOptions remesh;  ///< on which the cuts are chosen
  FrameOptions frame;
  double density = 1.0;        ///< for mass and inertia
  std::string format = "obj";  ///< ending of the files of parts, see part_files.h
};

/// Throws Error(InvalidInput) for options out of range or that do not go together.
void check_job(const ClumpJob& options);
void check_job(const ConvexJob& options);

/// Returns the job. Its table, grains.csv, has the columns of the report of one grain.
GrainJob make_job(const ClumpJob& options, const std::string& folder, const Shard& shard = {});
GrainJob make_job(const ConvexJob& options, const std::string& folder, const Shard& shard = {});

}  // namespace wscvt
