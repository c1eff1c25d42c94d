// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/on_scan.h"

#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/nodes/equalization.h"
#include "wscvt/remesh/contact_fit.h"
#include "wscvt/repair/handles.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

namespace {

ScanNodesOptions nodes_options(const OnScanOptions& options) {
  ScanNodesOptions nodes;
  nodes.weighting = options.weighting;
  nodes.curvature_alpha = options.curvature_alpha;
  nodes.edge_ratio = options.edge_ratio;
  nodes.fitted = options.placement != ScanPlacement::OnSurface;
  return nodes;
}

/// Measures nodes anew that have moved since their placement.
void measure_moved(const Execution& execution, Nodes& nodes, ScanNodesReport& report) {
  const EditMesh moved(nodes.mesh.points, nodes.mesh.triangles, execution);
  nodes.cell_areas = voronoi_areas(moved);
  report.mean_edge_ratio = mean_edge_ratio(moved);
  report.self_intersections = self_intersections(nodes.mesh, execution).size();
}

}  // namespace

HandleReport treat_handles(CheckedMesh& scan, const OnScanOptions& options,
                           const Execution& execution) {
  const int genus = scan.report.genus;
  if (genus == 0) return {};
  if (options.handles.action == HandleAction::Refuse) {
    refuse("The scan has " + format_count(genus, "handle") +
           " (tunnels through the grain), but the options do not allow handles. Use " +
           mention(HandleAction::Cut) + " or " + mention(HandleAction::Keep) + ".");
  }
  if (options.handles.action == HandleAction::Cut && options.handles.length_limit > 0.0) {
    return cut_handles(scan, options.handles, execution);
  }
  HandleReport report;
  report.kept = genus;
  return report;
}

ScanMethod::ScanMethod(const NormalizedScan& scan, const RadialSurface* surface,
                       const OnScanOptions& options, int most_nodes, bool with_curvatures,
                       const Execution& execution)
    : scan_(scan),
      surface_(surface),
      options_(options),
      with_curvatures_(with_curvatures),
      remesher_(scan.mesh, nodes_options(options), most_nodes, execution) {}

Nodes ScanMethod::place(int node_count, const Execution& execution) const {
  ScanNodes placed = remesher_.place(node_count, execution.part(0.0, 0.95));
  Nodes nodes;
  nodes.mesh = std::move(placed.mesh);
  nodes.cell_areas = std::move(placed.cell_areas);
  if (options_.placement == ScanPlacement::ContactFit) {
    nodes.mesh.points =
        fit_to_contacts(nodes.mesh, scan_.mesh, options_.contact_radius, execution.part(0.95, 1.0));
    measure_moved(execution, nodes, placed.report);
  } else if (options_.placement == ScanPlacement::OnSurface && surface_ != nullptr) {
    for (Vector3& point : nodes.mesh.points) {
      const Vector3 direction = point.normalized();
      point = surface_->radius(direction) * direction;
    }
    measure_moved(execution, nodes, placed.report);
  }
  if (with_curvatures_) nodes.curvatures = largest_curvatures(nodes.mesh, execution);
  nodes.report = OnScanReport{{}, placed.report, 0};
  return nodes;
}

}  // namespace wscvt
