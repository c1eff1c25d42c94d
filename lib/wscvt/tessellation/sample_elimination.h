// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/mapped_surface.h"

namespace wscvt {

/// The directions on the sphere of the map, unit vectors, of `count` >= 4 places spread evenly over
/// a mapped surface, from which a relaxation in space starts: neither near each other nor far apart
/// anywhere, and as many at one end of a long body as at the other, which a relaxation could not
/// bring about. `densities` is the wanted number per area, any common scale, at the vertices of the
/// surface's mesh; empty for the same everywhere.
///
/// Weighted sample elimination (Yuksel 2015, "Sample elimination for generating Poisson disk sample
/// sets", Computer Graphics Forum 34 (2), 25-32): of five times as many places those are taken out,
/// one after another, that others crowd most. Places on sheets that face away from each other do
/// not crowd each other, however near they are. Should the few that are asked for not surround the
/// sphere's centre, a Fibonacci lattice on the sphere. The same bytes on any number of threads.
///
/// Throws Error: InvalidInput for a count below 4 and other numbers of densities, Cancelled.
std::vector<Vector3> spread_seeds(const MappedSurface& surface,
                                  const std::vector<double>& densities, int count,
                                  const Execution& execution);

}  // namespace wscvt
