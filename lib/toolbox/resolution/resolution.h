// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

struct ResolutionOptions {
  double voxel_size = 1.0;  ///< edge of a voxel, > 0; length
  int smoothing = 20;       ///< passes with which the grain was made, see smoothed_surface
  DetailedOptions details;  ///< with which the grain was described
};

/// Estimates what the voxels did to the descriptors of a grain that was made of the voxels of a
/// label (label_grains.h). The grain is voxelised once more, with voxels of the same size in three
/// poses, and made and described as the first time: a value v and its mean w. What that takes away,
/// v - w, tells what the first voxels took away. The corrected value is v + f v + g (v - w). Gain g
/// and floor f depend on the descriptor and on the voxels across. With g = 1 and f = 0 this would
/// be the bias correction of a bootstrap (Efron 1979); g is larger, because the grain has already
/// lost its finest detail, and f is what smoothing does to every grain. Gains, floors and the
/// widths of the intervals were measured on other bodies with the default smoothing
/// (descriptor_biases.h).
///
/// For area and sphericity, w is of a surface of the first voxels themselves, with 5 passes of
/// smoothing instead of 20: it keeps more of the voxels' steps, but also more of the grain. The
/// scatter is then |v - w| times 10 over the voxels across. The voxels are found again in the mesh
/// (voxels_of_surface). Nothing is resolved of a mesh that does not show them, as after a turn, or
/// from marching cubes.
///
/// `descriptors` are the mesh's, measured with options.details. Throws Error(InvalidInput) for
/// options out of range or a grain of more than 20,000 voxels across; Error(Cancelled).
Resolution measure_resolution(const IndexedMesh& mesh, const DetailedDescriptors& descriptors,
                              const ResolutionOptions& options, const Execution& execution);

/// Measures the resolution of a grain described by measure_grain, with the same `details`.
/// `voxel_size`: edge of a voxel, > 0; length. Throws as measure_resolution.
void add_resolution(GrainMeasures& measures, double voxel_size, const DetailedOptions& details,
                    const Execution& execution);

}  // namespace wscvt
