// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/prepared_grain.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/remesh/as_published.h"
#include "wscvt/remesh/on_scan.h"
#include "wscvt/remesh/repaired_scan.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

namespace {

bool measures_distances(const RemeshOptions& options) {
  return options.measures.distances ||
         (searches(options) && options.target.measure == ErrorMeasure::Distance);
}

/// Returns the largest number of nodes that will be asked for.
int most_nodes(const RemeshOptions& options) {
  return searches(options) ? std::max(options.node_count, options.target.largest_node_count)
                           : options.node_count;
}

void add_radii(RemeshResult& result) {
  for (const Vector3& point : result.mesh.points) {
    const double radius = point.norm();
    result.radial_distances.push_back(radius);
    result.directions.push_back(radius > 0.0 ? Vector3(point / radius) : Vector3::UnitX());
  }
}

void add_distances(const PreparedGrain& grain, RemeshResult& result, const Execution& execution) {
  execution.report(0.0, "Measuring distances");
  if (grain.distance) {
    result.distances = measure_distances(result.mesh, grain.scan.mesh, *grain.distance,
                                         usual_distance_samples, execution);
    result.vertex_distances = grain.distance->signed_distances(result.mesh.points, execution);
    result.rms_distance = result.distances->root_mean_square;
    result.largest_distance = result.distances->largest;
    return;
  }
  // Costs a tenth of a run, and gives the rms to some per cent. One way is not enough: a flake's
  // mesh that reaches beyond its rim was told at .227 % where both ways have .829. On four samples
  // and three scans, with 100 to 2000 nodes, it was at most 2.4 % off (against 400,000), 0.7 % on
  // average; with twice as many at most 2.0 %.
  constexpr std::size_t samples = 5000;
  const MeshDistances sampled = sampled_distances(result.mesh, grain.scan.mesh, samples, execution);
  result.rms_distance = sampled.root_mean_square;
  result.largest_distance = sampled.largest;
}

/// Nodes on the series are never nearer to the scan than the series, however many they are.
void refuse_below_series(const AsPublishedOptions& published, const ErrorTarget& target,
                         const HarmonicFitReport& fit) {
  if (target.percent == 0.0 || target.measure != ErrorMeasure::Distance ||
      published.placement != PublishedPlacement::Series) {
    return;
  }
  // In units of the normalized scan, with equivalent radius 1; at other points the residual is
  // within five per cent.
  const double reach = 100.0 * fit.residual;
  if (!(target.percent < 0.95 * reach)) return;
  refuse("The allowed error is " + format_number(target.percent) +
         " % of the equivalent radius, but the SH surface itself is " + format_number(reach, 3) +
         " % off the scan. Nodes on it are not closer. Allow a larger error, raise " +
         mention(harmonic_degree_option) + ", or use " + mention(Method::OnScan) + ".");
}

/// Prepares the method in the options. This is where it is chosen.
void choose_method(const RemeshOptions& options, const Execution& execution, PreparedGrain& grain) {
  const bool with_curvatures = options.measures.node_curvatures;
  if (const auto* on_scan = std::get_if<OnScanOptions>(&options.method)) {
    grain.method = std::make_unique<ScanMethod>(grain.scan, nullptr, *on_scan, most_nodes(options),
                                                with_curvatures, execution.part(0.0, 0.8));
    if (options.measures.series) {
      grain.coefficients =
          options.measures.series(grain.scan.mesh, options.degree, execution.part(0.8, 0.9));
    }
  } else {
    const auto& published = std::get<AsPublishedOptions>(options.method);
    auto method = std::make_unique<PublishedRemesher>(grain.scan, published, options.degree,
                                                      with_curvatures, execution.part(0.0, 0.9));
    refuse_below_series(published, options.target, method->fit());
    grain.coefficients.radius = method->coefficients();
    grain.method = std::move(method);
  }
  if (measures_distances(options)) {
    grain.distance.emplace(grain.scan.mesh, execution.part(0.9, 1.0));
  }
}

}  // namespace

void prepare(CheckedMesh checked, const RemeshOptions& options, const Execution& execution,
             PreparedGrain& grain) {
  if (const auto* on_scan = std::get_if<OnScanOptions>(&options.method)) {
    grain.handles = treat_handles(checked, *on_scan, execution.part(0.0, 0.1));
  }
  grain.input = checked.report;
  grain.scan = normalize(std::move(checked.mesh), checked.report.centroid,
                         checked.report.equivalent_radius, execution.part(0.1, 0.2));
  choose_method(options, execution.part(0.2, 1.0), grain);
}

void prepare(const RadialSurface& scaled, const SurfaceIntegrals& integrals, double unit,
             const RemeshOptions& options, const Execution& execution, PreparedGrain& grain) {
  const auto* on_scan = std::get_if<OnScanOptions>(&options.method);
  // 40,962 points, whose chords lose 0.02 % of the volume; as a scan four times as many.
  const int frequency = on_scan == nullptr ? 64 : 128;
  IndexedMesh samples = mesh_of_surface(scaled, frequency, execution.part(0.0, 0.3));
  // Fitted nodes get the volume of their scan, so the scan gets the surface's volume. Its
  // equivalent radius is then 1, as for any scan.
  const double radius = on_scan == nullptr ? 1.0 : equivalent_radius(volume_of(samples, execution));
  grain.scan = normalize(std::move(samples), Vector3::Zero(), radius, execution.part(0.3, 0.5));
  grain.scan.unit = unit;
  grain.input.volume = integrals.volume;
  grain.input.area = integrals.area;
  grain.input.centroid = integrals.centroid;
  grain.input.equivalent_radius = unit;
  grain.input.components = 1;
  // The integrals are over the surface itself, without its mesh's chords.
  grain.scan.shape.volume = 4.0 * pi / 3.0;
  grain.scan.shape.area = integrals.area / (unit * unit);
  grain.scan.shape.sphericity = 4.0 * pi / grain.scan.shape.area;
  const bool with_curvatures = options.measures.node_curvatures;
  if (on_scan != nullptr) {
    grain.method = std::make_unique<ScanMethod>(grain.scan, &scaled, *on_scan, most_nodes(options),
                                                with_curvatures, execution.part(0.5, 0.9));
  } else {
    grain.method = std::make_unique<PublishedRemesher>(
        scaled, std::get<AsPublishedOptions>(options.method), with_curvatures);
  }
  if (measures_distances(options)) {
    grain.distance.emplace(grain.scan.mesh, execution.part(0.9, 1.0));
  }
}

namespace {

constexpr const char* intersects = "triangles of their mesh intersect";

/// A mesh with a larger rms distance, in equivalent radii, leaves out a part of the grain. A
/// tetrahedron with the volume of a ball is off by 0.17, plates with too few nodes by 0.55 and
/// more.
constexpr double beside = 0.5;
/// With fewer nodes, a mesh that is not refused is looked at for all that few nodes do.
constexpr std::size_t few = 200;

/// Why a remesh has too few nodes for a thin or long body, as the end of a sentence; empty if it
/// has not. A number to recommend must pass all that few nodes must pass.
std::string too_few(const PreparedGrain& grain, const RemeshOptions& options,
                    const IndexedMesh& mesh, bool is_recommended, const Execution& execution) {
  if (!(volume_of(mesh, execution) > 0.0)) return "their mesh encloses no volume";
  const bool is_large = mesh.points.size() >= few && !is_recommended;
  if (!is_large && !self_intersections(mesh, execution).empty()) return intersects;
  // As published, warnings say that the remesh is another body.
  if (std::get_if<OnScanOptions>(&options.method) == nullptr) return "";
  // Thin with the scan between its faces: a tetrahedron of a ball has 1.5 times its area.
  if (!is_large && describe_shape(mesh, execution).area > 2.0 * grain.scan.shape.area) {
    return "their mesh reaches beyond it";
  }
  constexpr std::size_t samples = 1000;
  if (rms_distance(grain.scan.mesh, mesh, samples, execution) > beside) {
    return "their mesh does not reach all of it";
  }
  return "";
}

/// Refuses a number of nodes that is too small for a thin or long body, with one that was tried and
/// is enough. If none is, or if the scan `meets_itself`, a remesh whose triangles intersect is not
/// refused.
void refuse_too_few(const PreparedGrain& grain, const RemeshOptions& options,
                    const IndexedMesh& mesh, bool meets_itself, const Execution& execution) {
  const std::string reason = too_few(grain, options, mesh, false, execution);
  // More nodes follow the sheets that meet more closely. The shrink-wrap helps (see remesh).
  if (reason.empty() || (reason == intersects && meets_itself)) return;
  const auto count = static_cast<int>(mesh.points.size());
  const bool has_stray = grain.input.stray_distance > 0.0;
  const std::string needs =
      (has_stray ? stray_vertex_sentence(grain.input) +
                       " Correct this vertex if it does not belong to the scan. So long a spike"
                 : std::string("So long or thin a body")) +
      " needs more than " + std::to_string(count) + " nodes: " + reason + ". ";
  constexpr int most_tried = 5000;
  int last = count;
  for (const int times : {2, 3, 5, 10, 20, 50, 100, 200}) {
    if (times > 10 && times * count > most_tried) break;
    last = times * count;
    const Nodes tried = grain.method->place(last, execution);
    if (!too_few(grain, options, tried.mesh, true, execution).empty()) continue;
    refuse(needs + std::to_string(last) + " were tried and are enough. Use that number.");
  }
  if (reason == intersects) return;  // as the warnings tell
  refuse(needs + "Up to " + std::to_string(last) + " were tried and are not enough. Use more.");
}

}  // namespace

RemeshResult remesh_prepared(const PreparedGrain& grain, const RemeshOptions& options,
                             int node_count, const Execution& execution) {
  RemeshResult result;
  result.options = options;
  result.options.node_count = node_count;
  Nodes nodes = grain.method->place(node_count, execution.part(0.0, 0.9));
  const bool is_few = nodes.mesh.points.size() < few || !(volume_of(nodes.mesh, execution) > 0.0);
  auto* on_scan = std::get_if<OnScanReport>(&nodes.report);
  const bool meets_itself = on_scan != nullptr && on_scan->nodes.scan_self_intersections > 0;
  if (is_few && !searches(options)) {
    refuse_too_few(grain, options, nodes.mesh, meets_itself, execution);
  } else if (on_scan != nullptr && on_scan->nodes.self_intersections > 0 && !meets_itself) {
    on_scan->enough_nodes = grain.method->enough_above(node_count, execution.part(0.9, 0.9));
  }
  result.mesh = std::move(nodes.mesh);
  result.cell_areas = std::move(nodes.cell_areas);
  result.curvatures = std::move(nodes.curvatures);
  result.method = std::move(nodes.report);
  if (auto* report = std::get_if<OnScanReport>(&result.method)) report->handles = grain.handles;
  add_radii(result);
  execution.report(0.9, "Measuring the remesh");
  result.remesh = describe_shape(result.mesh, execution.part(0.9, 0.92));
  result.quality = measure_quality(result.mesh, execution);
  add_distances(grain, result, execution.part(0.92, 0.98));
  if (!is_few && !searches(options) && result.rms_distance > beside) {
    refuse_too_few(grain, options, result.mesh, meets_itself, execution);
  }
  result.centre = grain.scan.centre;
  result.input = grain.input;
  result.steep_area_fraction = grain.steep_area_fraction;
  result.coefficients = grain.coefficients;
  result.scan = grain.scan.shape;
  result.scan_quality = grain.scan.quality;
  to_input_units(grain.scan.unit, grain.scan.centre, result);
  if (auto* report = std::get_if<OnScanReport>(&result.method)) {
    // Counts again for the triangles that are returned or written. Their corners are rounded anew
    // at the scan's position, or with fewer digits. Other pairs may then intersect than about the
    // origin, if sheets are close.
    const auto& written = options.measures.written;
    report->nodes.self_intersections =
        self_intersections(written ? written(result) : result.mesh, execution.part(0.98, 1.0))
            .size();
  }
  return result;
}

}  // namespace wscvt
