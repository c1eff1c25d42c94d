// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "figures/study/table.h"
#include "wscvt/base/execution.h"

namespace wscvt::study {

/// Volume and area of the NIST/VCCTL particles in a folder, integrated over their harmonics, beside
/// the values in the tables that come with the sets: every row of a *-geom.csv whose particle file
/// is there. Columns of those tables: 1 the file, 8 volume, 9 area, 13 the degree at which the
/// series is cut. Throws std::runtime_error when there is none, or a row cannot be read.
Table reference_particle_errors(const std::string& folder, const Execution& execution);

}  // namespace wscvt::study
