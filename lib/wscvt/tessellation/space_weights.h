// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/harmonic_map.h"
#include "wscvt/surface/mapped_surface.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

/// Which weighting a mapped surface follows. A radius, or a solid angle seen from the centre, says
/// nothing about a cell there: WSCVT-D and Constant are the area weighting.
Weighting weighting_in_space(Weighting asked);

/// Whether a weighting reads the curvature of the scan's harmonic map: WSCVT-C by
/// CurvatureSource::Series.
bool reads_map_series(const WeightingOptions& options);

/// Principal curvatures at the vertices of a mapped scan, for a weighting, 1 / length: those of
/// `series`, the scan's harmonic map, where the weighting reads it, and elsewhere of quadrics over
/// two rings. Empty for weightings that read none. `series` may be null where it is not read;
/// throws Error(InvalidInput) where it is, and for options out of range; Error(Cancelled).
std::vector<PrincipalCurvatures> curvatures_in_space(const MappedSurface& surface,
                                                     const HarmonicMap* series,
                                                     const WeightingOptions& options,
                                                     const Execution& execution);

/// The wanted number of nodes per area at every vertex of a mesh, any common scale; empty for the
/// area weighting, which wants the same everywhere.
///
/// `curvatures` are one pair a vertex, taken as root mean square over caps of 0.6 h, h = sqrt(area
/// / node_count), like those of SurfaceSeedModel. WSCVT-C gives a cell the area that eqs. 11 to 14
/// and the law "cell area = 3.118 w + C" give it on the unit sphere, with mean and deviation over
/// the surface; ErrorAdaptive the density k^exponent.
///
/// Throws Error(InvalidInput) for options out of range and another number of curvatures.
std::vector<double> densities_in_space(const IndexedMesh& mesh,
                                       const std::vector<PrincipalCurvatures>& curvatures,
                                       const WeightingOptions& options, int node_count);

}  // namespace wscvt
