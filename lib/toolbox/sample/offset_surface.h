// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "toolbox/sample/harmonic_grid.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

class MappedSurface;

// Grains with overhangs, over the sphere of directions u: x(u) = r(u) u + o(u). A star-shaped grain
// has only a radius r and no offset o.

/// SH series of the x, y and z of an offset, all of one degree; all empty if there is no offset.
using OffsetSeries = std::array<std::vector<double>, 3>;

inline bool has_offset(const OffsetSeries& offset) { return !offset[0].empty(); }

/// Returns the root mean square length of an offset over all directions; 0 without an offset.
double rms_offset(const OffsetSeries& offset);

/// A surface in some directions.
struct RadiiAndOffsets {
  std::vector<double> radii;  ///< above 0
  std::array<std::vector<double>, 3> offsets;
};

/// Splits points x(u) of a surface about as large as the unit sphere. The radius is the component
/// along u if that is above 0.2, and goes smoothly to 0 below it.
RadiiAndOffsets split_points(const std::vector<Vector3>& points,
                             const std::vector<Vector3>& directions);

/// Returns o(u) in some directions.
std::vector<Vector3> offset_values(const OffsetSeries& offset,
                                   const std::vector<Vector3>& directions);

/// Returns x(u) in some directions, from the series of r and o.
std::vector<Vector3> surface_points(const std::vector<double>& radial, const OffsetSeries& offset,
                                    const std::vector<Vector3>& directions);

/// Returns the surface times `scale`, as series of x, y and z.
HarmonicMap harmonic_map_of(const std::vector<double>& radial, const OffsetSeries& offset,
                            double scale);

/// Returns the series of the mirror image's offset: signs of 1 or -1 for x, y and z.
OffsetSeries mirrored_offset(const OffsetSeries& offset, const Vector3& signs);

/// Maps a closed mesh of genus 0 to the sphere, so that its points get the directions in which they
/// are seen from the origin, as far as the overhangs allow. The directions of map_to_sphere are
/// replaced by those of the mesh's SH series, smoothed until it is star-shaped. Throws
/// Error(InvalidInput) if even the coarsest shape of the mesh has no such directions, and what
/// map_to_sphere throws.
MappedSurface spread_over_directions(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
