// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/job/template_job.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt::program {

/// Measures the grains of the files of shape_files. If the only input is a table (.csv) or a folder
/// with shape.csv, reads them from this table, with columns "scan.volume" or "volume". A grain's
/// mesh is then the scan named in the table, or the table's file if there is no scan. `keys` are
/// keys of list_descriptors. Throws wscvt::Error.
DescribedSample described_sample(const std::vector<std::string>& inputs,
                                 const std::vector<std::string>& keys, int threads, bool quiet);

/// Returns a grain of the sample as a closed mesh. Throws wscvt::Error.
IndexedMesh grain_mesh(const std::string& file, const Execution& execution);

}  // namespace wscvt::program
