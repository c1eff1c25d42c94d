// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "wscvt/base/execution.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/normal_least_squares.h"
#include "wscvt/nodes/triangle_mending.h"
#include "wscvt/surface/mapped_surface.h"
#include "wscvt/tessellation/space_relaxation.h"

namespace wscvt {

/// Whether mending changed anything.
bool has_mended(const TriangleMendingReport& report);

/// Fits nodes along their normals (fit_along_normals), after `mended` came of the tessellation's:
/// samples of the scan are dealt out over the sphere to the triangles that were, and from there on
/// to those that are. `to_scan` as in mapped_samples; `volume` > 0, length^3. Throws
/// Error(NumericalFailure) as fit_along_normals does, Error(Cancelled).
NormalFit fit_mended(const MappedSurface& surface, const MeshDistance* to_scan,
                     const SpaceTessellation& tessellation, const MendedTriangles& mended,
                     double volume, const Execution& execution);

/// Nodes fitted anew.
struct MendedNodes {
  IndexedMesh mesh;
  TriangleMendingReport mending;
  NormalFitReport fit;
};

/// For nodes that were fitted radius by radius to a star-shaped scan, of which `fitted` has a
/// triangle with a smaller angle than mending allows (35 degrees): the seeds of long bodies are as
/// uneven as their radii, and leave some. `tessellation` holds them on the scan, where they are
/// mended, its directions being a map of the scan, and fitted to it along their normals.
///
/// None where no angle is too small, where a face of the scan does not look outward from the
/// origin, or where the smallest angle is no larger afterwards or a triangle does not look outward
/// any more: then the nodes stay as they are. Throws as fit_mended.
std::optional<MendedNodes> mend_radial_nodes(const IndexedMesh& scan, const IndexedMesh& fitted,
                                             const SpaceTessellation& tessellation, double volume,
                                             const Execution& execution);

}  // namespace wscvt
