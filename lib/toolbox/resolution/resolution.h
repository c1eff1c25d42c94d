// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

struct ResolutionOptions {
  double voxel_size = 1.0;  ///< edge of a voxel, > 0; length
  int smoothing = 20;       ///< passes with which the grain was made, see smoothed_surface
  DetailedOptions details;  ///< with which the grain was described
};

/// Estimates what the voxels did to the descriptors of a grain that was made of the voxels of a
/// label (label_grains.h). The grain is voxelised anew with voxels of twice the size, in four
/// poses, and described: a value v(h) and its mean v(2 h). The corrected value is (1 + f) v(h) +
/// (v(h) - v(2 h)) / (2^p - 1): Richardson's extrapolation with the order p of the descriptor. The
/// floor f is what is left at any size of the voxels, because smoothing leaves some of their steps.
/// Orders, floors and the widths of the intervals were measured on other bodies with the default
/// smoothing (descriptor_orders.h).
///
/// `descriptors` are the mesh's, measured with options.details. Throws Error(InvalidInput) for
/// options out of range or a grain of more than 20,000 voxels across; Error(Cancelled).
Resolution measure_resolution(const IndexedMesh& mesh, const DetailedDescriptors& descriptors,
                              const ResolutionOptions& options, const Execution& execution);

}  // namespace wscvt
