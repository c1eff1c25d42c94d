// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/job/grain_job.h"
#include "toolbox/sample/given_sizes.h"
#include "toolbox/sample/grain_grower.h"
#include "toolbox/sample/sample_grain.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

inline constexpr NumberOption<int> grown_count_option = {"count", "number of grains", 1, 10000000};
inline constexpr NumberOption<int> grown_nodes_option = {"nodes",    "number of nodes", 12, 1000000,
                                                         Ends::Both, "of each mesh"};

/// Virtual grains with the statistics of a sample, as files in a folder.
struct GrowJob {
  std::string folder;
  Shard shard;
  int grains = 1000;
  int nodes = 500;                     ///< of each mesh
  std::string format = "ply";          ///< ending of the meshes; "json": SH coefficients instead
  int degree = usual_harmonic_degree;  ///< of the SH series of the real grains
  GrowOptions options;
  std::optional<GivenSizes> sizes;  ///< empty: those of the sample
};

/// The real grains.
struct RealGrains {
  std::vector<SampleGrain> grains;  ///< of the job's degree
  std::vector<std::string> files;   ///< one per grain
  std::size_t left_out = 0;         ///< grains that could not be read
};

/// Throws Error(InvalidInput) for options out of range.
void check_job(const GrowJob& job);

/// Throws Error(InvalidInput) if a grown grain's file would replace one of the real grains' files.
void require_scans_kept(const GrowJob& job, const std::vector<std::string>& real);

/// Makes the grains: a file each, and grown.csv with a row each. Throws as run_job and GrainGrower,
/// and for the first grain that cannot be made.
MadeSample grow_grains(const GrowJob& options, RealGrains real, const SampleGrids& grids,
                       const JobHost& host);

}  // namespace wscvt
