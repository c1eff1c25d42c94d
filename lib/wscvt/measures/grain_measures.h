// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/surface_texture.h"
#include "wscvt/measures/voxel_resolution.h"
#include "wscvt/repair/scan_options.h"

namespace wscvt {

/// A mesh and its name: a layer or a file.
struct NamedMesh {
  std::string name;
  IndexedMesh mesh;
};

/// A grain with its descriptors.
struct MeasuredGrain {
  std::string name;
  CheckedMesh checked;
  DetailedDescriptors descriptors;
  SurfaceTexture texture = {};
  std::string crossing_remark = {};  ///< on triangles that intersect; empty without
};

/// A grain and an optional reference for errors and distances.
struct GrainMeasures {
  MeasuredGrain grain;
  std::optional<MeasuredGrain> reference;
  std::optional<MeshDistances> distances;  ///< between the two; length
  std::optional<Resolution> resolution;    ///< of the grain, if the caller measures it
};

/// Measures one grain, or a grain, its reference and the distances between them. Throws Error as
/// check_mesh and describe_shape_in_detail, with the grain's name before the message;
/// Error(Cancelled) without the name.
GrainMeasures measure_grain(NamedMesh grain, std::optional<NamedMesh> reference,
                            const DetailedOptions& options, const Execution& execution);

/// Compares the grain's descriptors with the reference's. There must be a reference.
std::vector<DescriptorComparison> compare_descriptors(const GrainMeasures& measures);

/// Returns warnings about the numbers: parts left out, descriptors that do not exist, overhangs.
/// Without `all` those of roughness and Sdq are left out, for a log that does not have these.
std::vector<Sentence> remarks(const GrainMeasures& measures, bool all = true);

}  // namespace wscvt
