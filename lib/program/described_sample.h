// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt::program {

/// Grains of a sample with the descriptors that templates are chosen by.
struct DescribedSample {
  std::vector<std::string> files;  ///< of the grains: meshes or SH coefficients
  std::vector<double> diameters;   ///< of the spheres of equal volume, length
  Eigen::MatrixXd descriptors;     ///< grains x names
  std::size_t left_out = 0;
};

/// The descriptors that templates are chosen by unless told otherwise.
const std::vector<std::string>& usual_template_descriptors();

/// Measures the grains of the inputs, as shape_files finds them, or reads them from the inputs'
/// only table (.csv), or from shape.csv in their only folder. Its columns may be named
/// "scan.volume" or "volume". A grain's mesh is the scan that a batch's table names, or the table's
/// file if there is no scan there. `keys` are those of list_descriptors. Throws wscvt::Error.
DescribedSample described_sample(const std::vector<std::string>& inputs,
                                 const std::vector<std::string>& keys, int threads, bool quiet);

/// A grain of the sample as a closed mesh. Throws wscvt::Error.
IndexedMesh grain_mesh(const std::string& file, const Execution& execution);

}  // namespace wscvt::program
