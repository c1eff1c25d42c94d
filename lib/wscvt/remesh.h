// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

class HarmonicMap;
class RadialSurface;
struct GrainSurface;

// "The paper" of this library's comments is F. Wu, L. Huang, Z. Lai, "A spherical Voronoi
// tessellation-based approach for particle surface discretization and reconstruction", Engineering
// Mechanics, 2022, doi 10.6052/j.issn.1000-4750.2022.07.0614. "Length" is the unit of the mesh's
// coordinates, "equivalent radius" that of the sphere of the scan's volume.

/// Remeshes a dense scan to exactly N nodes, by the method whose options are given. The scan is
/// taken by value, since it is repaired and centred; a caller that needs it no more moves it in.
/// Throws Error: InvalidInput for options out of range and meshes that cannot be repaired (see
/// check_mesh), NotStarShaped as published when the overhang fraction is above its limit,
/// NumericalFailure, Cancelled.
///
/// With the option `points` the scan's points are triangulated first (see mesh_of_points, which
/// also says what it throws): `original` is then that of the surface made for them, and the result
/// carries a warning.
RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Remeshes a scan to several numbers of nodes, which are prepared once. Each result is that of
/// remesh with this number, in the order of `node_counts`; only the first holds the repaired scan.
/// Throws Error as remesh does, and Error(InvalidInput) without a number of nodes, with an error
/// target and with suggestions.
std::vector<RemeshResult> remesh_levels(IndexedMesh scan, RemeshOptions options,
                                        const std::vector<int>& node_counts,
                                        const Execution& execution = Execution());

/// Remeshes a surface given by a formula or by coefficients, about its own origin. As published
/// takes the surface itself in the place of the series and of the scan. On the scan takes a mesh of
/// 163,842 of its points, and nodes on the surface are moved along their rays onto the surface
/// itself. Volume, area and sphericity of `original` are integrals over the surface, everything
/// else is measured on a mesh of it. The options of a scan's repair have no meaning here. Throws
/// Error: InvalidInput for options out of range and surfaces that cannot be integrated (see
/// integrate), NumericalFailure, Cancelled.
RemeshResult remesh(const RadialSurface& surface, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Remeshes the surface of a harmonic map, as a mesh of 40,962 of its points: a series of low
/// degree turns some of its area inside out at edges and limbs, which no formula of it helps.
/// Throws the same as for a scan.
RemeshResult remesh(const HarmonicMap& map, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Remeshes the surface of the formula or the coefficients that `surface` names, by one of the two
/// functions above. Reads their file. Throws as those and make_surface do.
RemeshResult remesh(const GrainSurface& surface, const RemeshOptions& options,
                    const Execution& execution = Execution());

}  // namespace wscvt
