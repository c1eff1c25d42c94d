// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/scan_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/nodes/coarsening.h"
#include "wscvt/nodes/equalization.h"
#include "wscvt/nodes/fit_state.h"
#include "wscvt/nodes/fit_steps.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/long_edges.h"
#include "wscvt/surface/self_intersections.h"
#include "wscvt/surface/triangle_hash.h"

namespace wscvt {

namespace {

/// A scan with fewer vertices per node, or with faces longer than a node's edges, is split first,
/// because nodes can only be as even as the vertices of their clusters. At 8, scans in between gain
/// .5 % of rms for a tenth of the time.
constexpr std::size_t least_vertices_a_node = 6;
/// Faces are split until there are about so many.
constexpr std::size_t split_vertices_a_node = 8;
/// Edges longer than this many edges of even faces are split.
constexpr double long_edge = 1.4;
/// Splitting may give up to this many times the scan's vertices and the wanted ones. Boxes 1000
/// times as long as wide need 2 times as many.
constexpr std::size_t most_splits = 20;
/// Above this many vertices per node the scan is coarsened by complete sweeps, which about halve
/// it, to the surface for equalization.
constexpr std::size_t most_proxy_vertices_a_node = 30;
/// A scan of more vertices per node is not looked at for long faces.
constexpr std::size_t most_split_vertices_a_node = 90;
/// Before a fit. The rms of 44 grains at 1000 nodes is .6 % smaller than with 100 steps without
/// over-relaxation; with 50 steps it is the same, with 80 it is 1.7 % smaller.
constexpr EqualizationSteps steps_before_fit = {60, 2.0};
/// Of nodes that stay on the surface, and of few. Over-relaxation makes those of WSCVT-C less even,
/// and moves twelve nodes of a needle from its ends.
constexpr EqualizationSteps plain_steps = {100, 1.0};
constexpr int few_nodes = 100;
/// Equalization and the fit change the contrast of a density; these powers of the wanted density
/// correct it in advance. For a scan of sand and 1000 nodes, the logarithm of the nodes' density
/// then has a slope of .32 to .37 against the logarithm of the largest curvature (of the scan's
/// series of degree 20 at each node). On smooth bodies, equalized nodes have the slope of the
/// weighting's own law.
constexpr double evened_steepness = 0.7;
constexpr double fitted_steepness = 0.82;
/// Smallest number of samples, for few nodes, whose cells are so large that a fixed number per node
/// would scatter: four nodes on a ball are a tetrahedron within 3 % only with 120.
constexpr std::size_t fewest_samples = 6000;
/// Samples per node of a scan with fewer vertices than nodes, which is flat between them.
constexpr int samples_of_coarse_scan = 16;
/// If a number of nodes is too few, up to this many times as many are tried.
constexpr int most_tried_times = 3;
/// Below this many vertices per node, the cheapest merge of all is made each time.
constexpr int heap_vertices_a_node = 2;

void check_scan_options(const ScanNodesOptions& options) {
  if (!(options.edge_ratio >= least_edge_ratio && options.edge_ratio <= most_edge_ratio)) {
    refuse("The wanted mean edge ratio is " + std::to_string(options.edge_ratio) +
           ". Give a number from 1.08 to 1.6.");
  }
  if (!(std::abs(options.curvature_alpha) <= 3.0)) {
    refuse("The strength alpha of the curvature weighting is " +
           std::to_string(options.curvature_alpha) + ". Give a number from -3 to 3.");
  }
}

std::size_t genus_of(const EditMesh& mesh) {
  // V - E + F = 2 - 2 g, and E = 3 F / 2.
  const auto euler = static_cast<std::int64_t>(mesh.points.size()) -
                     static_cast<std::int64_t>(mesh.triangles.size() / 2);
  return static_cast<std::size_t>((2 - euler) / 2);
}

}  // namespace

struct ScanParts {
  const IndexedMesh& scan;
  Coarsening base;                          ///< of the scan, as far as for any number of nodes
  std::vector<std::int32_t> base_clusters;  ///< its vertex for each of the scan's; empty: identical
  double volume = 0.0;
  double area = 0.0;
  std::size_t genus = 0;
};

namespace {

/// Nodes in preparation, with their surface.
struct Placing {
  SplitScan split;  ///< if needed
  EqualizationSurface surface;
  std::vector<std::int32_t> on_surface;  ///< vertex of the surface for each of the scan's
  EditMesh nodes;                        ///< without triangles if there cannot be so few
  std::vector<std::int32_t> clusters;    ///< node for each vertex of the surface
};

/// Coarsens by complete sweeps to at most `most` vertices.
void sweep_below(Coarsening& coarsening, std::size_t most, const Execution& execution) {
  while (coarsening.size() > most) {
    execution.report(0.0, "Coarsening the scan");
    if (coarsening.sweep(1) == 0) break;
  }
}

/// Whether an edge of a scan is longer than the edges of even nodes with a cell of this area. No
/// cluster has a vertex within such an edge, as in the flat faces of a plate.
bool has_long_faces(const IndexedMesh& scan, double cell) {
  const double most = 2.0 / std::sqrt(3.0) * cell;
  const auto is_long = [&](std::int32_t v, std::int32_t w) {
    return (scan.points[v] - scan.points[w]).squaredNorm() > most;
  };
  return std::any_of(scan.triangles.begin(), scan.triangles.end(), [&](const Triangle& t) {
    return is_long(t[0], t[1]) || is_long(t[1], t[2]) || is_long(t[2], t[0]);
  });
}

/// Coarsens to exactly `count` vertices; false if handles need more.
bool coarsen(Coarsening& coarsening, int count, const Execution& execution) {
  const auto size = [&] { return static_cast<int>(coarsening.size()); };
  while (size() > heap_vertices_a_node * count) {
    execution.report(0.0, "Coarsening the scan");
    if (coarsening.sweep(heap_vertices_a_node * count) == 0) break;
  }
  if (coarsening.reduce(count, execution)) return true;
  coarsening.ignore_shapes();
  return coarsening.reduce(count, execution);
}

/// Returns the least number of vertices of a closed surface of a genus: V (V - 7) >= 12 (g - 1)
/// (Heawood 1890; Jungerman and Ringel 1980, Acta Math. 145, 121; except g = 2, which needs 10).
int fewest_nodes(std::size_t genus) {
  if (genus == 0) return 4;
  if (genus == 2) return 10;
  return static_cast<int>(std::ceil(0.5 * (7.0 + std::sqrt(1.0 + 48.0 * genus))));
}

[[noreturn]] void refuse_too_few(int count, std::size_t genus, int enough) {
  const int fewest = fewest_nodes(genus);
  const std::string handles = format_count(genus, "handle");
  Sentence text =
      count < fewest
          ? "A closed mesh with " + handles + " needs at least " + std::to_string(fewest) +
                " nodes, not " + std::to_string(count) + "."
          : std::to_string(count) + " nodes are too few for the grain's " + handles + ".";
  if (enough > 0) {
    text +=
        " " + std::to_string(enough) +
        " were tried and are enough for them. Use that number or more; a thin grain may need more.";
  } else {
    text += " Up to " + std::to_string(most_tried_times * count) +
            " were tried and are not enough. Use more, or cut the handles by a larger " +
            mention("max-handle-loop") + ".";
  }
  refuse(text);
}

/// Returns a triangle of the surface for each node: about the nearest vertex of its cluster.
std::vector<std::int32_t> places_on(const EditMesh& surface, const EditMesh& nodes,
                                    const std::vector<std::int32_t>& clusters) {
  std::vector<std::int32_t> places(nodes.points.size(), 0);
  std::vector<double> nearest(nodes.points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < clusters.size(); ++v) {
    const std::int32_t node = clusters[v];
    const double squared = (surface.points[v] - nodes.points[node]).squaredNorm();
    if (squared >= nearest[node]) continue;
    nearest[node] = squared;
    places[node] = static_cast<std::int32_t>(face_of(surface.first[v]));
  }
  return places;
}

}  // namespace

ScanRemesher::ScanRemesher(const IndexedMesh& normalized_scan, const ScanNodesOptions& options,
                           int most_nodes, const Execution& execution)
    : options_(options) {
  check_scan_options(options);
  execution.report(0.0, "Coarsening the scan");
  EditMesh mesh(normalized_scan.points, normalized_scan.triangles, execution);
  const MeshSums sums =
      mesh_sums(normalized_scan.points, normalized_scan.triangles, Vector3::Zero(), execution);
  const std::size_t genus = genus_of(mesh);
  const auto parts = std::make_shared<ScanParts>(ScanParts{
      normalized_scan, Coarsening(std::move(mesh), {}), {}, sums.volume(), sums.area(), genus});
  parts_ = parts;
  const std::size_t vertices = parts->base.size();
  // A number tried after a smaller one failed gives the same result as when it is asked for.
  sweep_below(parts->base,
              most_split_vertices_a_node *
                  static_cast<std::size_t>(most_tried_times * std::max(most_nodes, 4)),
              execution);
  if (parts->base.size() == vertices) return;
  parts->base_clusters = parts->base.forget();
}

namespace {

/// Coarsens to the surface for equalization, then to the nodes.
Placing coarsen_to_nodes(const ScanParts& parts, const ScanNodesOptions& options, int node_count,
                         const Execution& execution) {
  Placing placing;
  Coarsening coarsening = parts.base;
  const std::size_t scan_vertices = parts.scan.points.size();
  const auto nodes = static_cast<std::size_t>(node_count);
  const bool is_coarse = scan_vertices < least_vertices_a_node * nodes ||
                         (scan_vertices <= most_split_vertices_a_node * nodes &&
                          has_long_faces(parts.scan, parts.area / node_count));
  if (is_coarse) {
    EditMesh split = parts.base.mesh();
    const double cell = parts.area / static_cast<double>(split_vertices_a_node * nodes);
    const double even_edge = std::sqrt(2.0 / std::sqrt(3.0) * cell);
    const std::size_t most = most_splits * (scan_vertices + split_vertices_a_node * nodes);
    placing.split = split_long_edges(split, long_edge * even_edge, most, execution);
    coarsening = Coarsening(std::move(split), {});
  }
  sweep_below(coarsening, most_proxy_vertices_a_node * nodes, execution);
  const std::size_t vertices = is_coarse ? placing.split.mesh.points.size() : scan_vertices;
  placing.on_surface.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto start = static_cast<std::int32_t>(v);
    placing.on_surface[v] = coarsening.cluster_of(
        is_coarse || parts.base_clusters.empty() ? start : parts.base_clusters[v]);
  }
  coarsening.forget();
  placing.surface.mesh = coarsening.mesh();
  const IndexedMesh surface = {placing.surface.mesh.points, placing.surface.mesh.triangles};
  if (options.weighting == CellWeighting::Curvature) {
    placing.surface.density =
        steepened(curvature_density(surface, options.curvature_alpha, node_count, execution),
                  surface, options.fitted ? fitted_steepness : evened_steepness);
  }
  if (!placing.surface.density.empty()) {
    coarsening = Coarsening(placing.surface.mesh, placing.surface.density);
  }
  if (!coarsen(coarsening, node_count, execution)) return placing;
  placing.nodes = coarsening.mesh();
  placing.clusters.resize(placing.surface.mesh.points.size());
  for (std::size_t v = 0; v < placing.clusters.size(); ++v) {
    placing.clusters[v] = coarsening.cluster_of(static_cast<std::int32_t>(v));
  }
  return placing;
}

/// Returns samples of the scan, and in `near` the nodes that represent their vertices.
std::vector<FitSample> samples_near_nodes(const ScanParts& parts, const Placing& placing,
                                          const FitDial& dial, std::vector<std::int32_t>& near) {
  const IndexedMesh& split = placing.split.mesh;
  const IndexedMesh& scan = split.points.empty() ? parts.scan : split;
  const std::size_t nodes = placing.nodes.points.size();
  const std::size_t wanted =
      nodes * static_cast<std::size_t>(parts.scan.points.size() < nodes ? samples_of_coarse_scan
                                                                        : dial.samples_a_node);
  std::vector<FitSample> samples =
      draw_fit_samples(scan, placing.split.normals, std::max(wanted, fewest_samples),
                       parts.area / static_cast<double>(nodes));
  near.reserve(samples.size());
  for (FitSample& sample : samples) {
    const std::int32_t vertex = placing.on_surface[sample.face];
    if (!placing.surface.density.empty()) {
      sample.spacing = 1.0 / std::sqrt(placing.surface.density[vertex]);
    }
    near.push_back(placing.clusters[vertex]);
  }
  return samples;
}

/// Fits the nodes to the scan and gives them its volume. Then separates intersecting triangles and
/// gives the volume again.
EditMesh fit(const ScanParts& parts, const ScanNodesOptions& options, const Placing& placing,
             ScanNodesReport& report, const Execution& execution) {
  const FitDial dial = fit_dial(options.edge_ratio, !placing.surface.density.empty());
  std::vector<std::int32_t> near;
  std::vector<FitSample> samples = samples_near_nodes(parts, placing, dial, near);
  FitState state(placing.nodes, std::move(samples), near, dial, execution);
  const SurfaceFitReport fitted = fit_to_samples(state, execution);
  report.fit_rounds = fitted.rounds;
  report.fit_flips = fitted.flips;
  report.relocations = fitted.relocations;
  report.polished = fitted.polished;
  EditMesh nodes = std::move(state.mesh);
  report.volume_offset = offset_to_volume(nodes.points, nodes.triangles, parts.volume);
  constexpr int most_partings = 3;
  for (int round = 0; round < most_partings; ++round) {
    const PartingReport parted = part_triangles(nodes, execution);
    report.repaired_intersections += parted.before - parted.after;
    report.self_intersections = parted.after;
    if (parted.before == parted.after) return nodes;
    report.volume_offset += offset_to_volume(nodes.points, nodes.triangles, parts.volume);
  }
  report.self_intersections = self_intersections({nodes.points, nodes.triangles}, execution).size();
  return nodes;
}

bool may_intersect(const EditMesh& mesh, const Execution& execution) {
  TriangleHash hash;
  hash.build(mesh, mean_edge_length(mesh));
  return !hash.pairs(mesh, execution).empty();
}

}  // namespace

ScanNodes ScanRemesher::place(int node_count, const Execution& execution) const {
  if (node_count < 4) {
    refuse("The number of nodes is " + std::to_string(node_count) + ". Give 4 or more.");
  }
  std::optional<ScanNodes> result = try_to_place(node_count, execution);
  const Execution more = execution.part(1.0, 1.0);
  if (!result) refuse_too_few(node_count, parts_->genus, enough_above(node_count, more));
  ScanNodesReport& report = result->report;
  if (report.self_intersections > 0) {
    report.scan_self_intersections = self_intersections(parts_->scan, more).size();
  }
  return *std::move(result);
}

int ScanRemesher::enough_above(int node_count, const Execution& execution) const {
  for (const double times : {1.25, 1.6, 2.0, 2.5, static_cast<double>(most_tried_times)}) {
    const int count = static_cast<int>(std::ceil(times * node_count));
    const std::optional<ScanNodes> more = try_to_place(count, execution);
    if (more && more->report.self_intersections == 0) return count;
  }
  return 0;
}

std::optional<ScanNodes> ScanRemesher::try_to_place(int node_count,
                                                    const Execution& execution) const {
  const ScanParts& parts = *parts_;
  ScanNodes result;
  ScanNodesReport& report = result.report;
  Placing placing = coarsen_to_nodes(parts, options_, node_count, execution.part(0.0, 0.2));
  if (placing.nodes.triangles.empty()) return std::nullopt;
  report.scan_vertices = parts.scan.points.size();
  if (!placing.split.mesh.points.empty()) {
    report.split_vertices = placing.split.mesh.points.size() - report.scan_vertices;
  }
  report.proxy_vertices = placing.surface.mesh.points.size();
  report.genus = parts.genus;

  std::vector<std::int32_t> places =
      places_on(placing.surface.mesh, placing.nodes, placing.clusters);
  const bool is_relaxed = options_.fitted && node_count >= few_nodes;
  const EqualizationReport evening =
      even_nodes(placing.nodes, places, placing.surface,
                 is_relaxed ? steps_before_fit : plain_steps, execution.part(0.2, 0.4));
  report.equalization_steps = evening.steps;
  report.equalization_flips = evening.flips;
  // The fit separates what it can by itself; rounded numbers tell whether there is anything.
  if (!options_.fitted || may_intersect(placing.nodes, execution)) {
    const PartingReport parted = part_triangles(placing.nodes, execution.part(0.4, 0.42));
    report.repaired_intersections = parted.before - parted.after;
    report.self_intersections = parted.after;
  }
  EditMesh nodes = options_.fitted
                       ? fit(parts, options_, placing, report, execution.part(0.42, 1.0))
                       : std::move(placing.nodes);
  report.mean_edge_ratio = mean_edge_ratio(nodes);
  result.cell_areas = voronoi_areas(nodes);
  result.mesh = {std::move(nodes.points), std::move(nodes.triangles)};
  return result;
}

}  // namespace wscvt
