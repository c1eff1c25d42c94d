// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "toolbox/job/grow_job.h"
#include "toolbox/job/template_job.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt::program {

/// Returns the files of a sample's grains, sorted by name: the files of grain_files. A folder
/// without meshes gives its files of SH coefficients, .dat and .sh, or else .json. Throws
/// wscvt::Error.
std::vector<std::string> shape_files(const std::vector<std::string>& inputs);

/// Returns whether the file contains SH coefficients, by its ending.
bool is_coefficient_file(const std::string& path);

/// Calls `read` for the number of each file, on several threads at once, with a progress line on a
/// terminal unless quiet. Reports files that `read` refuses on the standard error, and returns
/// their number. Throws wscvt::Error, also Cancelled, for errors that do not concern one file.
std::size_t read_each(const std::vector<std::string>& files, int threads, bool quiet,
                      const std::function<void(std::size_t file, const Execution&)>& read);

/// Reads the grains, with a progress line on a terminal unless quiet. Throws wscvt::Error, also
/// Cancelled, for errors that do not concern one grain.
RealGrains read_shapes(const std::vector<std::string>& files, const SampleGrids& grids, int threads,
                       bool quiet);

/// Measures the grains of the files of shape_files. If the only input is a table (.csv) or a folder
/// with shape.csv, reads them from this table, with columns "scan.volume" or "volume". A grain's
/// mesh is then the scan named in the table, or the table's file if there is no scan. `keys` are
/// keys of list_descriptors. Throws wscvt::Error.
DescribedSample described_sample(const std::vector<std::string>& inputs,
                                 const std::vector<std::string>& keys, int threads, bool quiet);

/// Returns a grain of the sample as a closed mesh. Throws wscvt::Error.
IndexedMesh grain_mesh(const std::string& file, const Execution& execution);

}  // namespace wscvt::program
