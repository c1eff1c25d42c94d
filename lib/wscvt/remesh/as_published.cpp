// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/as_published.h"

#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/distances.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/harmonic_fit.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

namespace {

/// Above this overhang fraction, the series' residual is measured against the whole scan. The rays
/// of the fit see only the outermost surface. Their residual is within 2 % below this fraction
/// (four scans). Above, it is up to 12 % too small, and 54 % if 8 % lie behind another sheet.
constexpr double told_by_rays = 1e-3;

std::string on_scan_accepts() {
  return ". It accepts closed grains with overhangs, and with up to " +
         std::to_string(most_handles_cut) + " handles.";
}

void refuse_overhang(double overhang_fraction, double limit) {
  if (overhang_fraction >= 1.0) {
    throw Error(ErrorCode::NotStarShaped,
                "The grain is not star-shaped: its volume centroid lies outside of it or on its "
                "surface. Use " +
                    mention(Method::OnScan) + on_scan_accepts());
  }
  if (overhang_fraction > limit) {
    throw Error(ErrorCode::NotStarShaped,
                "The grain is not star-shaped: overhangs cover " +
                    format_above(100.0 * limit, 100.0 * overhang_fraction) +
                    " % of the sphere (limit " + format_number(100.0 * limit) + " %). Use " +
                    mention(Method::OnScan) + on_scan_accepts() + " Or raise " +
                    mention(max_overhang_option) + " and check the result.");
  }
}

/// Returns the rms distance from the scan, with all its sheets, to the series; length.
double residual_with_overhangs(const IndexedMesh& scan, const RadialSurface& series,
                               const Execution& execution) {
  // 5,762 points, whose edges are a sixth of the wavelength of degree 20. The samples are enough to
  // measure the few on hidden sheets, which are far from it, within 1 %.
  constexpr int frequency = 24;
  constexpr std::size_t samples = 10000;
  return rms_distance(scan, mesh_of_surface(series, frequency, execution), samples, execution);
}

/// Returns seeds at rest, with their cells.
RelaxationResult tessellate(const RadialSurface& surface, const AsPublishedOptions& options,
                            int node_count, const Execution& execution) {
  execution.report(0.0, "Computing weights");
  const bool weighted = options.sampling == Sampling::Weighted;
  const WeightingOptions weighting = {weighted ? options.weighting : Weighting::Constant,
                                      options.curvature_alpha};
  const SurfaceSeedModel model(surface, weighting, node_count, execution);
  RelaxationOptions relaxation;
  if (!weighted) {
    relaxation.maximum_iterations = 0;
    return relax(unrelaxed_seeds(options.sampling, node_count), model, relaxation, execution);
  }
  const int coarsest = level_sizes(node_count).front();
  return relax_multilevel(start_seeds(model, coarsest, execution), node_count, model, relaxation,
                          execution.part(0.1, 1.0));
}

}  // namespace

PublishedRemesher::PublishedRemesher(const NormalizedScan& scan, const AsPublishedOptions& options,
                                     int degree, bool with_curvatures, const Execution& execution)
    : options_(options), with_curvatures_(with_curvatures) {
  execution.report(0.0, "Looking for overhangs");
  const double overhang = overhang_solid_angle(scan.mesh, Vector3::Zero(), execution);
  report_.overhang_fraction = overhang;
  refuse_overhang(overhang, 0.01 * options.max_overhang_percent);
  execution.report(0.1, "Casting rays");
  rays_.emplace(scan.mesh, Vector3::Zero(), 1.0, overhang, execution);
  HarmonicFit fit = fit_harmonics(*rays_, degree, execution.part(0.4, 1.0));
  report_.fit = fit.report;
  series_.emplace(std::move(fit.surface));
  surface_ = &*series_;
  if (overhang > told_by_rays) {
    report_.fit.residual = residual_with_overhangs(scan.mesh, *surface_, execution);
  }
}

PublishedRemesher::PublishedRemesher(const RadialSurface& surface,
                                     const AsPublishedOptions& options, bool with_curvatures)
    : options_(options), with_curvatures_(with_curvatures), surface_(&surface) {}

Nodes PublishedRemesher::place(int node_count, const Execution& execution) const {
  RelaxationResult relaxed = tessellate(*surface_, options_, node_count, execution.part(0.0, 0.9));
  execution.report(0.9, "Placing the nodes");
  Nodes nodes;
  const std::vector<Vector3>& directions = relaxed.seeds;
  AreaElements read = area_elements(*surface_, directions, execution);
  nodes.cell_areas = std::move(relaxed.cell_areas);
  for (std::size_t i = 0; i < directions.size(); ++i) nodes.cell_areas[i] *= read.elements[i];
  std::vector<double> radii = std::move(read.radii);
  if (options_.placement == PublishedPlacement::Surface && rays_) {
    radii = rays_->radii(directions, execution);
  }
  nodes.mesh.points.resize(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    nodes.mesh.points[i] = radii[i] * directions[i];
  }
  relaxed.triangulation.restore_surface_delaunay(directions, nodes.mesh.points, execution);
  nodes.mesh.triangles = relaxed.triangulation.triangles();
  if (with_curvatures_) nodes.curvatures = largest_curvatures(*surface_, directions, execution);
  AsPublishedReport report = report_;
  report.relaxation = std::move(relaxed.report);
  nodes.report = std::move(report);
  return nodes;
}

}  // namespace wscvt
