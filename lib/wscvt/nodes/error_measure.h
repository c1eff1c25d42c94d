// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/nodes_options.h"

namespace wscvt {

/// A remesh's error against the original by a measure, in %, >= 0. `distances` between the two are
/// needed for Distance only and are lengths like the descriptors'. Throws Error(InvalidInput) when
/// they are needed and missing.
double error_percent(ErrorMeasure measure, const ShapeDescriptors& remesh,
                     const ShapeDescriptors& original,
                     const std::optional<MeshDistances>& distances);

}  // namespace wscvt
