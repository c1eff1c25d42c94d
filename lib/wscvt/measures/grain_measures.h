// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/scan/scan_options.h"

namespace wscvt {

/// A mesh and what it is called: a layer or a file.
struct NamedMesh {
  std::string name;
  IndexedMesh mesh;
};

/// A grain with its descriptors.
struct MeasuredGrain {
  std::string name;
  CheckedMesh checked;
  DetailedDescriptors descriptors;
};

/// A grain, and perhaps a second one that errors and distances are taken against.
struct GrainMeasures {
  MeasuredGrain grain;
  std::optional<MeasuredGrain> reference;
  std::optional<MeshDistances> distances;  ///< between the two; length
};

/// Measures one grain, or two and what lies between them. Throws Error as check_mesh and
/// describe_shape_in_detail do, with the grain's name before the sentence; Error(Cancelled) without
/// it.
GrainMeasures measure_grain(NamedMesh grain, std::optional<NamedMesh> reference,
                            const DetailedOptions& options, const Execution& execution);

/// The grain's descriptors against the reference's. There must be one.
std::vector<DescriptorComparison> compare_descriptors(const GrainMeasures& measures);

/// Warnings about the numbers, in sentences: parts left out, descriptors
/// that do not exist, folds.
std::vector<std::string> remarks(const GrainMeasures& measures);

}  // namespace wscvt
