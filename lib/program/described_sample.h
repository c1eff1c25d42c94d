// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt::program {

/// Grains of a sample with the descriptors for the choice of templates.
struct DescribedSample {
  std::vector<std::string> files;  ///< of the grains: meshes or SH coefficients
  std::vector<double> diameters;   ///< of the spheres of equal volume, length
  Eigen::MatrixXd descriptors;     ///< grains x names
  std::size_t left_out = 0;
};

/// Returns the default descriptors for the choice of templates.
const std::vector<std::string>& usual_template_descriptors();

/// Measures the grains of the files of shape_files. If the only input is a table (.csv) or a folder
/// with shape.csv, reads them from this table, with columns "scan.volume" or "volume". A grain's
/// mesh is then the scan named in the table, or the table's file if there is no scan. `keys` are
/// keys of list_descriptors. Throws wscvt::Error.
DescribedSample described_sample(const std::vector<std::string>& inputs,
                                 const std::vector<std::string>& keys, int threads, bool quiet);

/// Returns a grain of the sample as a closed mesh. Throws wscvt::Error.
IndexedMesh grain_mesh(const std::string& file, const Execution& execution);

}  // namespace wscvt::program
