// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/mapped_surface.h"
#include "wscvt/surface/sphere_surface.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/relaxation.h"

namespace wscvt {

/// Sites on a surface over the sphere, and their triangulation there.
struct SpaceTessellation {
  std::vector<Vector3> seeds;         ///< unit: where the sites lie on the sphere
  std::vector<Vector3> positions;     ///< the sites, on the surface
  SphereTriangulation triangulation;  ///< of the seeds; no triangle turned on the sphere
  std::vector<double> cell_areas;     ///< of the surface, length^2
  RelaxationReport report;
};

/// No step and no flip takes the determinant of a triangle's seeds below this: it stays far above
/// rounding, also in the triangles that a subdivision cuts it into. A million even triangles have
/// determinants of 1e-5; a sheet of the map that is squeezed to a thread gets stuck here, where it
/// would else end in triangles of which arithmetic cannot tell whether they stand.
inline constexpr double smallest_seed_determinant = 1e-12;

/// The wanted number of sites per area in a direction, > 0, in any common scale; empty for the same
/// everywhere. The place is that of SphereSurface::position_near in this direction, so that nothing
/// is searched twice. Called from several threads.
using SiteDensity = std::function<double(const Vector3& direction, const MeshPlace& place)>;

/// A density given at the vertices of the surface's mesh, linear between; none for no values. What
/// is given must outlive it. Throws Error(InvalidInput) for another number of values than vertices.
SiteDensity site_density(const MappedSurface& surface, const std::vector<double>& values);

/// The seed, unit, on the great arc between two (unit, not opposite) where the surface is as far
/// from it to both in space, by six bisections; no nearer to an end than a tenth of their chord.
Vector3 halfway_seed(const SphereSurface& surface, const Vector3& a, const Vector3& b);

/// The seeds of a coarsest level: the directions of the `count` vertices that the collapse kept
/// longest, which lie evenly over the surface; where the mesh has fewer vertices, all of them and
/// the middles of the largest triangles. `collapse_order` is the map's. Throws Error(InvalidInput)
/// for a count below 4.
std::vector<Vector3> surviving_seeds(const MappedSurface& surface,
                                     const std::vector<std::int32_t>& collapse_order, int count);

/// Relaxes sites in space, on any surface over the sphere, such as a mapped scan: a centroidal
/// Voronoi tessellation of the surface itself, whatever its shape, with the sphere as its guard.
///
/// Cells and centroids are those of the sites' positions (CellGeometry::Surface). A site's shift
/// is written as a combination of itself and two neighbours of its ring in space; its seed becomes
/// the same combination of seeds on the sphere, and the site is looked up there again, so that it
/// never leaves the surface. Should any triangle turn over on the sphere, the step is made again
/// one site after the other, each as far as its ring allows, by halves. Edges are flipped by their
/// angles in space, but only where both new triangles stand upright on the sphere. So the
/// triangulation stays a bijection to the sphere, exactly: limbs that come near each other cannot
/// grow together, which a relaxation on the surface alone lets them do.
///
/// Steps, momentum (whose "uphill" is measured in space), the fall back to plain steps and the
/// report are those of relax(); `options.metric` has no meaning here. The levels are those of
/// relax_multilevel; edges are cut where the surface is as far from both ends.
///
/// `start` has as many seeds as the coarsest of level_sizes(count, levels.coarsest_seeds).
///
/// The same bytes on any number of threads. Throws Error(InvalidInput) for options out of range and
/// for another number of seeds, Error(NumericalFailure) when the start cannot be triangulated,
/// Error(Cancelled).
SpaceTessellation relax_in_space(std::vector<Vector3> start, int count,
                                 const SphereSurface& surface, const SiteDensity& density,
                                 const RelaxationOptions& options, const MultilevelOptions& levels,
                                 const Execution& execution);

/// The same for sites that have a triangulation already, on one level.
SpaceTessellation relax_in_space(std::vector<Vector3> seeds, SphereTriangulation triangulation,
                                 const SphereSurface& surface, const SiteDensity& density,
                                 const RelaxationOptions& options, const Execution& execution);

}  // namespace wscvt
