// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/surface/sphere_surface.h"
#include "wscvt/tessellation/space_relaxation.h"

namespace wscvt {

/// How a tessellation's cells compare with the wanted ones about each seed, one number a seed:
/// areas / wanted areas, in the mean over some three rings about it, so that single cells do not
/// count; 1 where all is as wanted. `density` is that of relax_in_space, and what its result is
/// measured by: a wanted area goes by 1 / density.
std::vector<double> cell_shares(const SphereSurface& surface, const SiteDensity& density,
                                const SpaceTessellation& tessellation);

/// How many seeds too many stand where cells are that much too small that no relaxation has
/// helped, by their shares: below nine tenths, which also rough scans keep to.
double crowded_seeds(const std::vector<double>& shares);

/// Takes seeds from where they crowd to where cells are too large, as many as `shares` (one a seed)
/// says are too many: where a limb hangs on a neck of a few cells, seeds jam there and neither a
/// relaxation nor its coarser levels get them past it. A seed's triangles are joined to one of its
/// ring and the seed is put on the longest edge about another, halfway on the surface; each only
/// where all triangles stand on the sphere. Returns how many went. Of `tessellation` seeds,
/// positions and triangulation follow, but not the cells: it is to be relaxed again.
int relocate_seeds(const SphereSurface& surface, const std::vector<double>& shares,
                   SpaceTessellation& tessellation);

}  // namespace wscvt
