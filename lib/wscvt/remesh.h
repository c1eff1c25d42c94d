// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/remesh_options.h"
#include "wscvt/report/remesh_result.h"

namespace wscvt {

class HarmonicMap;
class RadialSurface;
struct GrainSurface;

// "The paper" of this library's comments is F. Wu, L. Huang, Z. Lai, "A spherical Voronoi
// tessellation-based approach for particle surface discretization and reconstruction", Engineering
// Mechanics, 2022, doi 10.6052/j.issn.1000-4750.2022.07.0614. "Length" is the unit of the mesh's
// coordinates, "equivalent radius" that of the sphere of the scan's volume.

/// Remeshes a dense scan to exactly N nodes. The scan is taken by value, since it is mended and
/// centred; a caller that needs it no more moves it in. Throws Error: InvalidInput
/// for options out of range and meshes that cannot be mended (see check_mesh), NotStarShaped when
/// the folded share exceeds the limit, NumericalFailure, Cancelled.
///
/// With the option `points` the scan's points are triangulated first (see mesh_of_points, which
/// also says what it throws): `original` and `folded_share` are then those of the surface made for
/// them, and the result carries a warning.
RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Discretises a surface given by a formula or by coefficients, about its own origin, in the same
/// way. The surface takes the place of the fitted series, and of the scan where that is asked for;
/// volume, area and sphericity of `original` are integrals over it, everything else is measured on
/// a mesh of 40,962 of its points. The options `points`, `envelope`, `check`, `handles`, `surface`,
/// `weighting.curvature_source` and `measures.advice` have no meaning here. Throws Error:
/// InvalidInput for options out of range and surfaces that cannot be integrated (see integrate),
/// NumericalFailure, Cancelled.
RemeshResult remesh(const RadialSurface& surface, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Remeshes the surface of a harmonic map, as a mesh of 40,962 of its points: a series of low
/// degree turns some of its area inside out at edges and limbs, which no formula of it helps.
/// Throws the same as for a scan.
RemeshResult remesh(const HarmonicMap& map, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// One of the two above: of the formula or the coefficients that `surface` names. Reads their file.
/// Throws as those and make_surface do.
RemeshResult remesh(const GrainSurface& surface, const RemeshOptions& options,
                    const Execution& execution = Execution());

}  // namespace wscvt
