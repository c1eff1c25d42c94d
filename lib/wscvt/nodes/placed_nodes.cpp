// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/placed_nodes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/nodes/contact_fit.h"
#include "wscvt/nodes/mended_fit.h"
#include "wscvt/nodes/node_placement.h"
#include "wscvt/nodes/node_refinement.h"

namespace wscvt {

namespace {

void put_on_radii(PlacedNodes& nodes) {
  nodes.mesh.points.resize(nodes.directions.size());
  for (std::size_t i = 0; i < nodes.directions.size(); ++i) {
    nodes.mesh.points[i] = nodes.radii[i] * nodes.directions[i];
  }
}

/// Back from the points.
void take_polar_coordinates(PlacedNodes& nodes) {
  for (std::size_t i = 0; i < nodes.radii.size(); ++i) {
    nodes.radii[i] = nodes.mesh.points[i].norm();
    nodes.directions[i] = nodes.mesh.points[i] / nodes.radii[i];
  }
}

void mend(const Grain& grain, SphereTriangulation triangulation, double volume, PlacedNodes& nodes,
          const Execution& execution) {
  std::vector<Vector3> on_scan = nodes.directions;
  const std::vector<double> radii = grain.rays->radii(nodes.directions, execution);
  for (std::size_t i = 0; i < radii.size(); ++i) on_scan[i] *= radii[i];
  const SpaceTessellation tessellation{
      nodes.directions, std::move(on_scan), std::move(triangulation), {}, {}};
  std::optional<MendedNodes> mended =
      mend_radial_nodes(grain.mesh, nodes.mesh, tessellation, volume, execution);
  if (!mended) return;
  nodes.mesh = std::move(mended->mesh);
  nodes.mending = mended->mending;
  nodes.fit = mended->fit;
  take_polar_coordinates(nodes);
  nodes.cell_areas = vertex_areas(nodes.mesh);
}

void place_by_least_squares(const MeshSurface& scan, SphereTriangulation triangulation,
                            double volume, const RefinementOptions& refinement, PlacedNodes& nodes,
                            const Execution& execution) {
  // Points at which the radii read the scan: ten for every one of the usual scan's vertices, and
  // thirty a triangle at a thousand nodes.
  constexpr std::size_t fit_samples = 60000;
  nodes.radii =
      least_squares_radii(nodes.directions, nodes.mesh.triangles, scan, fit_samples, execution);
  put_on_radii(nodes);
  if (refinement.rounds > 0) {
    RefinedNodes refined = refine_nodes(radial_nodes(nodes.mesh.points), std::move(triangulation),
                                        RadialTarget(scan), refinement, execution.part(0.1, 1.0));
    nodes.mesh = {positions_of(refined.nodes), refined.triangulation.triangles()};
    nodes.refinement = std::move(refined.report);
  }
  scale_to_volume(nodes.mesh.triangles, volume, nodes.mesh.points, execution);
  take_polar_coordinates(nodes);
  if (refinement.rounds > 0) nodes.cell_areas = vertex_areas(nodes.mesh);
}

}  // namespace

void check_placement_options(const PlacementOptions& options) {
  require_in_range(options.contact_radius, contact_radius_option);
  check_refinement_options(options.refinement);
  if (options.refinement.rounds > 0 && !is_fitted(options.kind)) {
    throw Error(ErrorCode::InvalidInput,
                "Refinement takes the nodes off the surface they were to be placed on; place them "
                "by least squares, or set the rounds of the refinement to 0.");
  }
}

bool needs_rays(const PlacementOptions& options, bool is_scan) {
  return is_fitted(options.kind) || (options.kind == NodePlacement::Scan && is_scan);
}

PlacedNodes place_nodes(const Grain& grain, RelaxationResult relaxed, RelaxationMetric metric,
                        double volume, const PlacementOptions& options,
                        const Execution& execution) {
  check_placement_options(options);
  if (needs_rays(options, grain.is_scan) && !grain.rays) {
    throw Error(ErrorCode::InvalidInput,
                "The grain has no rays to place nodes by; make them before placing.");
  }
  execution.report(0.0, "Placing the nodes");
  PlacedNodes nodes;
  nodes.directions = std::move(relaxed.seeds);
  nodes.cell_areas = std::move(relaxed.cell_areas);
  SphereTriangulation& triangulation = relaxed.triangulation;
  AreaElements read = area_elements(*grain.surface, nodes.directions, execution);
  nodes.radii = std::move(read.distances);
  if (metric == RelaxationMetric::Sphere) {
    for (std::size_t i = 0; i < nodes.radii.size(); ++i) nodes.cell_areas[i] *= read.elements[i];
  }
  if (options.kind == NodePlacement::Scan && grain.is_scan) {
    nodes.radii = grain.rays->radii(nodes.directions, execution);
  }
  put_on_radii(nodes);
  triangulation.restore_surface_delaunay(nodes.directions, nodes.mesh.points, execution);
  nodes.mesh.triangles = triangulation.triangles();
  if (is_fitted(options.kind)) {
    place_by_least_squares(*grain.rays, triangulation, volume, options.refinement, nodes,
                           execution);
  }
  if (options.kind == NodePlacement::LeastSquares && options.refinement.rounds == 0 &&
      metric == RelaxationMetric::Surface && grain.is_scan) {
    mend(grain, std::move(triangulation), volume, nodes, execution.part(0.5, 1.0));
  }
  if (options.kind == NodePlacement::Contact) {
    nodes.mesh.points = fit_to_contacts(nodes.mesh, grain.mesh, nullptr, options.contact_radius,
                                        execution.part(0.5, 1.0));
    take_polar_coordinates(nodes);
    nodes.cell_areas = vertex_areas(nodes.mesh);
  }
  return nodes;
}

std::vector<double> largest_curvatures(const SphereSurface& surface,
                                       const std::vector<Vector3>& directions,
                                       const Execution& execution) {
  const std::vector<SurfaceJet> jets =
      surface.surface_jets(directions, Derivatives::Second, execution);
  std::vector<double> result;
  result.reserve(jets.size());
  for (std::size_t i = 0; i < jets.size(); ++i) {
    const PrincipalCurvatures k = principal_curvatures(jets[i], directions[i]);
    result.push_back(std::max(std::abs(k.maximum), std::abs(k.minimum)));
  }
  return result;
}

std::vector<double> largest_curvatures(const IndexedMesh& mesh, const Execution& execution) {
  constexpr int rings = 2;
  std::vector<double> result;
  result.reserve(mesh.points.size());
  for (const PrincipalCurvatures& k : quadric_fit_curvatures(mesh, rings, execution)) {
    result.push_back(std::max(std::abs(k.maximum), std::abs(k.minimum)));
  }
  return result;
}

}  // namespace wscvt
