// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/remesh/error_target.h"

namespace wscvt {

/// Returns a remesh's error against the scan by a measure, in %, >= 0. `distances` between the two
/// are needed for Distance only, in the descriptors' unit. Throws Error(InvalidInput) if they are
/// needed and missing.
double error_percent(ErrorMeasure measure, const ShapeDescriptors& remesh,
                     const ShapeDescriptors& scan, const std::optional<MeshDistances>& distances);

}  // namespace wscvt
