// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "figures/study/sampling_errors.h"
#include "figures/study/table.h"
#include "wscvt/base/execution.h"

namespace wscvt::study {

// Each of these writes the data a figure is drawn from into `folder` and returns its summary.

/// Figure 1: the samplings of the sphere as triangles, of about 500 points.
Table write_samplings(const std::string& folder, const Scan& scan, const Execution& execution);

/// Figures 6 and 9: the scan and its remeshes, WSCVT-D with the radius and WSCVT-C with the largest
/// absolute curvature at each corner, both by the equivalent radius R (r / R and k R).
Table write_pictures(const std::string& folder, const Scan& scan, const Execution& execution);

/// Figure 7: the shares of edges by length / mean and of triangles by longest / shortest edge, for
/// each scan and its WSCVT-D remesh with as many nodes.
Table write_distributions(const std::string& folder, const std::vector<Scan>& scans,
                          const Execution& execution);

}  // namespace wscvt::study
