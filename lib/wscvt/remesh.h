// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

class HarmonicMap;
class RadialSurface;
struct GrainSurface;

// In this library's comments, "the paper" is F. Wu, L. Huang, Z. Lai, "A spherical Voronoi
// tessellation-based approach for particle surface discretization and reconstruction", Engineering
// Mechanics, 2022, doi 10.6052/j.issn.1000-4750.2022.07.0614. "Length" is the unit of the mesh's
// coordinates. "Equivalent radius" is the radius of the sphere with the scan's volume.

/// Remeshes a dense scan to exactly N nodes by the chosen method. The function repairs and centres
/// its copy of the scan; move the scan in if you no longer need it. Throws Error: InvalidInput for
/// options out of range and for meshes that cannot be repaired (see check_mesh), NotStarShaped as
/// published if the overhang fraction is above its limit, NumericalFailure, Cancelled.
///
/// With the option `points`, mesh_of_points first makes a surface of the scan's points and may
/// throw its errors. `original` then describes this surface, and the result contains a warning.
RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Remeshes a half-edge mesh and carries its colours and its properties of double, float and int to
/// the result (see attributes_of and carried_attributes). Throws Error as for a flat mesh.
RemeshResult remesh(const Mesh& scan, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Returns the remesh as a half-edge mesh with what was carried as its properties (see to_mesh).
Mesh to_mesh(const RemeshResult& result);

/// Remeshes a scan to several numbers of nodes and prepares the scan once. Each result equals the
/// result of remesh for this number, in the order of `node_counts`; only the first contains the
/// repaired scan. Throws Error as remesh does, and Error(InvalidInput) without a number of nodes
/// and with an error target.
std::vector<RemeshResult> remesh_levels(IndexedMesh scan, RemeshOptions options,
                                        const std::vector<int>& node_counts,
                                        const Execution& execution = Execution());

/// Remeshes a surface given by a formula or by coefficients, about its own origin. As published,
/// the surface replaces both the SH series and the scan. On the scan, a mesh of 163,842 of its
/// points is remeshed, and nodes on the surface are moved along their rays onto the surface itself.
/// Volume, area and sphericity of `original` are integrals over the surface; all else is measured
/// on a mesh of it. The options of a scan's repair have no effect. Throws Error: InvalidInput for
/// options out of range and surfaces that cannot be integrated (see integrate), NumericalFailure,
/// Cancelled.
RemeshResult remesh(const RadialSurface& surface, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Remeshes the surface of a harmonic map, as a mesh of 40,962 of its points. A mesh is needed
/// because a series of low degree turns some area inside out at edges and limbs. Throws Error as
/// for a scan.
RemeshResult remesh(const HarmonicMap& map, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Remeshes the surface that `surface` describes, by one of the two functions above. Reads its
/// file. Throws as these functions and read_coefficients do.
RemeshResult remesh(const GrainSurface& surface, const RemeshOptions& options,
                    const Execution& execution = Execution());

}  // namespace wscvt
