// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/space_nodes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/contact_fit.h"
#include "wscvt/nodes/edge_evening.h"
#include "wscvt/nodes/mended_fit.h"
#include "wscvt/nodes/node_placement.h"
#include "wscvt/nodes/node_refinement.h"
#include "wscvt/nodes/normal_least_squares.h"
#include "wscvt/nodes/self_intersections.h"
#include "wscvt/nodes/triangle_mending.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/sphere_map.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/sample_elimination.h"
#include "wscvt/tessellation/seed_relocation.h"
#include "wscvt/tessellation/space_relaxation.h"
#include "wscvt/tessellation/space_weights.h"

namespace wscvt {

namespace {

constexpr std::size_t node_block = 256;
/// Nodes on the surface that lose more volume than this are too few: 25 nodes on a ball.
constexpr double largest_volume_loss = 0.25;
/// Of the seeds that crowd: from the first on they are taken elsewhere, down to the second.
constexpr double crowded_share_at_start = 0.05;
constexpr double crowded_share_at_end = 0.005;

double enclosed_volume(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles) {
  return mesh_sums(points, triangles, Vector3::Zero(), Execution(1)).volume();
}

/// The unrelaxed levels below a thousand seeds are left out: so few triangles on a body with thin
/// limbs are long on the sphere, get jammed there, and hand their unevenness down.
MultilevelOptions levels_in_space(const MultilevelOptions& levels, SeedStart start,
                                  int node_count) {
  constexpr int times = 8;
  MultilevelOptions result = with_more_seeds(levels, times);
  if (start != SeedStart::Multilevel) result.coarsest_seeds = node_count;
  return result;
}

/// Where the seeds of a coarsest level come from.
enum class SpaceStart {
  /// Vertices that the map's collapse kept longest: they lie where the shape is, and from there
  /// rough scans are met 3 % closer.
  Survivors,
  /// Places spread by area: thin rims and long limbs get their share, which survivors crowd.
  Spread,
};

/// `collapse_order` is that of the map.
SpaceTessellation tessellate(const MappedSurface& surface,
                             const std::vector<std::int32_t>& collapse_order, int node_count,
                             const SpaceTessellationOptions& options, SpaceStart from,
                             const std::vector<double>& densities, const Execution& execution) {
  const SeedingOptions& seeding = options.seeding;
  const RelaxationOptions& relaxation = options.relaxation;
  if (seeding.sampling != Sampling::Weighted) {
    RelaxationOptions none = relaxation;
    none.maximum_iterations = 0;
    std::vector<Vector3> seeds = unrelaxed_seeds(seeding.sampling, node_count);
    SphereTriangulation triangulation(seeds);
    return relax_in_space(std::move(seeds), std::move(triangulation), surface,
                          site_density(surface, densities), none, execution);
  }
  const MultilevelOptions in_space = levels_in_space(options.levels, seeding.start, node_count);
  const int coarsest = level_sizes(node_count, in_space.coarsest_seeds).front();
  std::vector<Vector3> start = seeding.start == SeedStart::Random && coarsest > 50
                                   ? random_directions(coarsest, seeding.random_seed)
                               : from == SpaceStart::Spread
                                   ? spread_seeds(surface, densities, coarsest, execution)
                                   : surviving_seeds(surface, collapse_order, coarsest);
  return relax_in_space(std::move(start), node_count, surface, site_density(surface, densities),
                        relaxation, in_space, execution);
}

/// Raises the density about the middles of triangles that meet: half as many nodes again there,
/// falling to none over two cells.
void raise_densities(const MappedSurface& surface, const SpaceTessellation& tessellation,
                     const std::vector<TrianglePair>& pairs, std::vector<double>& densities,
                     const Execution& execution) {
  const std::vector<Vector3>& points = surface.mesh().points;
  densities.resize(points.size(), 1.0);
  double area = 0.0;
  for (const double cell : tessellation.cell_areas) area += cell;
  const double reach = 2.0 * std::sqrt(area / static_cast<double>(tessellation.seeds.size()));
  std::vector<Vector3> places;
  for (const std::int32_t v : vertices_of(pairs, tessellation.triangulation.triangles())) {
    places.push_back(tessellation.positions[v]);
  }
  execution.parallel_for(points.size(), node_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double nearest = reach * reach;
      for (const Vector3& place : places) {
        nearest = std::min(nearest, (points[i] - place).squaredNorm());
      }
      densities[i] *= 1.0 + 0.5 * (1.0 - std::sqrt(nearest) / reach);
    }
  });
}

/// What is wrong with nodes on the surface.
struct Flaws {
  std::vector<TrianglePair> pairs;
  double volume_loss = 0.0;
  bool any() const { return !pairs.empty() || volume_loss > largest_volume_loss; }
};

Flaws flaws_of(const SpaceTessellation& tessellation, double volume, const Execution& execution) {
  const std::vector<Triangle>& triangles = tessellation.triangulation.triangles();
  return {self_intersections({tessellation.positions, triangles}, execution),
          1.0 - enclosed_volume(tessellation.positions, triangles) / volume};
}

/// Relaxations that give the places where triangles meet more nodes, each from where the one before
/// came to: one that helps little may be what the next one needs. Leaves the best of them in
/// `tessellation` and its flaws in `flaws`, and returns how many led to it.
int repair(const MappedSurface& surface, const RelaxationOptions& options, double volume,
           std::vector<double> densities, SpaceTessellation& tessellation, Flaws& flaws,
           const Execution& execution) {
  constexpr int most_repairs = 5;
  RelaxationOptions local = options;
  local.maximum_iterations = std::min(local.maximum_iterations, 200);
  SpaceTessellation latest = tessellation;
  Flaws left = flaws;
  int best = 0;
  for (int count = 1; count <= most_repairs && !flaws.pairs.empty(); ++count) {
    raise_densities(surface, latest, left.pairs, densities, execution);
    latest = relax_in_space(std::move(latest.seeds), std::move(latest.triangulation), surface,
                            site_density(surface, densities), local, execution);
    left = flaws_of(latest, volume, execution);
    if (left.pairs.size() >= flaws.pairs.size()) continue;
    best = count;
    latest.report.coarser_levels = tessellation.report.coarser_levels;
    tessellation = latest;
    flaws = left;
  }
  return best;
}

/// A tessellation, what is wrong with it, and what led to it.
struct Tessellated {
  SpaceTessellation tessellation;
  Flaws flaws;
  SpaceStart from = SpaceStart::Survivors;
  int repairs = 0;  ///< relaxations with more nodes where triangles had met
};

/// The better of both starts, where triangles meet from the first, repaired where they still do.
Tessellated tessellate_well(const MappedSurface& surface,
                            const std::vector<std::int32_t>& collapse_order, int node_count,
                            const SpaceTessellationOptions& options,
                            const std::vector<double>& densities, double volume,
                            const Execution& execution) {
  SpaceTessellation first = tessellate(surface, collapse_order, node_count, options,
                                       SpaceStart::Survivors, densities, execution.part(0.0, 0.6));
  Flaws its_flaws = flaws_of(first, volume, execution.part(0.6, 0.6));
  Tessellated result{std::move(first), std::move(its_flaws)};
  if (options.seeding.sampling != Sampling::Weighted || result.flaws.pairs.empty()) return result;
  // Who asks for a random start gets that.
  if (options.seeding.start != SeedStart::Random) {
    SpaceTessellation other = tessellate(surface, collapse_order, node_count, options,
                                         SpaceStart::Spread, densities, execution.part(0.6, 0.8));
    Flaws its = flaws_of(other, volume, execution.part(0.8, 0.8));
    const auto rank = [](const Flaws& found, const SpaceTessellation& of) {
      return std::pair(found.pairs.size(), of.report.history.back().displacement);
    };
    if (rank(its, other) < rank(result.flaws, result.tessellation)) {
      result.from = SpaceStart::Spread;
      result.tessellation = std::move(other);
      result.flaws = std::move(its);
    }
  }
  result.repairs = repair(surface, options.relaxation, volume, densities, result.tessellation,
                          result.flaws, execution.part(0.8, 1.0));
  return result;
}

/// Triangles on the surface, and what is left to mend of them: pairs that meet, small angles, and
/// how uneven the cells are. Less is better, in that order.
struct Laid {
  Tessellated nodes;
  MendedTriangles triangles;  ///< those of the nodes where a refinement follows
  std::size_t meeting = 0;    ///< pairs of these triangles

  /// A small angle in 20,000 triangles is not worth laying all of them again.
  bool is_flawed() const {
    constexpr std::size_t triangles_a_small_angle = 20000;
    const auto small_angles = static_cast<std::size_t>(triangles.report.left);
    return meeting > 0 || triangles_a_small_angle * small_angles > triangles.mesh.triangles.size();
  }
  bool is_better_than(const Laid& other) const { return rank() < other.rank(); }
  /// Whatever the cells.
  bool is_better_mended_than(const Laid& other) const {
    return std::pair(meeting, triangles.report.left) <
           std::pair(other.meeting, other.triangles.report.left);
  }

 private:
  std::tuple<std::size_t, int, double> rank() const {
    return {meeting, triangles.report.left, nodes.tessellation.report.history.back().area_spread};
  }
};

Laid lay(const MappedSurface& surface, Tessellated nodes, bool mends, const Execution& execution) {
  const std::size_t meeting = nodes.flaws.pairs.size();
  Laid result{std::move(nodes), {}, meeting};
  const SpaceTessellation& tessellation = result.nodes.tessellation;
  result.triangles.mesh = {tessellation.positions, tessellation.triangulation.triangles()};
  if (!mends) return result;
  result.triangles =
      mend_triangles(result.triangles.mesh, surface.locate(tessellation.seeds, execution), surface,
                     TriangleMendingOptions(), execution, meeting);
  // Mending makes none meet.
  if (meeting > 0) result.meeting = self_intersections(result.triangles.mesh, execution).size();
  return result;
}

/// Takes seeds that crowd in a limb, jammed on every map, to where they are wanted, and relaxes
/// them again, a few times: the lot with the fewest crowded seeds is taken where no more is to be
/// mended in it. From a twentieth of all seeds on: fewer were worth no other edges, and on a scan
/// with thin limbs, whose shape the crowded nodes follow better, cost distance. With 1,015 nodes
/// 161 stood in the wrong half of a rod with a neck, and edges deviated by 0.20 of their mean
/// length; 0.08 then.
void spread_crowded(const MappedSurface& surface, const std::vector<double>& densities,
                    const RelaxationOptions& relaxation, double volume, bool mends, Laid& best,
                    int& relocated, const Execution& execution) {
  constexpr int attempts = 5;
  const auto count = static_cast<double>(best.nodes.tessellation.seeds.size());
  SpaceTessellation latest = best.nodes.tessellation;
  const SiteDensity density = site_density(surface, densities);
  std::vector<double> shares = cell_shares(surface, density, latest);
  double crowded = crowded_seeds(shares);
  double fewest = crowded;
  if (crowded < crowded_share_at_start * count) return;
  int taken = 0;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (crowded < crowded_share_at_end * count) return;
    const Execution part =
        execution.part(attempt / double{attempts}, (attempt + 1) / double{attempts});
    const int going = relocate_seeds(surface, shares, latest);
    if (going == 0) return;
    taken += going;
    latest = relax_in_space(std::move(latest.seeds), std::move(latest.triangulation), surface,
                            density, relaxation, part);
    latest.report.coarser_levels = best.nodes.tessellation.report.coarser_levels;
    shares = cell_shares(surface, density, latest);
    crowded = crowded_seeds(shares);
    if (!(crowded < fewest)) continue;
    Laid other =
        lay(surface, {latest, flaws_of(latest, volume, part), best.nodes.from, best.nodes.repairs},
            mends, part.part(1.0, 1.0));
    if (best.is_better_mended_than(other)) continue;
    best = std::move(other);
    fewest = crowded;
    relocated = taken;
  }
}

/// Weights of the angles in the maps that are tried, one after the other, where the grain's own
/// jams the nodes. Rings about a neck that keep their areas become long thin triangles on the
/// sphere, and edges that are straight there cut across the next ring: nodes crowd and cannot pass
/// one another. Rounder rings let them pass. On a rod with a neck and 2,000, 5,000 and 10,000 nodes
/// 18, 113 and 177 small angles were left and 3, 3 and 23 pairs met, with these maps none; 3 helped
/// few grains that these do not.
constexpr double rounder_angle_weights[] = {10.0, 30.0};
constexpr int most_nodes_at_once = 20000;

/// Refines fitted nodes over the map, mends what small angles the sphere's guard has left, and
/// makes the volume exact again.
void refine_in_space(const MappedSurface& surface, const MeshDistance* to_level,
                     const SpaceTessellation& tessellation, const RefinementOptions& options,
                     double volume, SpaceNodes& result, const Execution& execution) {
  PlacedNodes& nodes = result.placed;
  const MappedTarget target(surface, to_level);
  RefinedNodes refined =
      refine_nodes(mapped_nodes(nodes.mesh.points, tessellation.seeds, surface, execution),
                   tessellation.triangulation, target, options, execution);
  nodes.mesh = {positions_of(refined.nodes), refined.triangulation.triangles()};
  nodes.refinement = std::move(refined.report);
  std::vector<MeshPlace> places;
  for (const RefinementNode& node : refined.nodes) places.push_back(node.place);
  TriangleMendingOptions mending;
  // Angles that the refinement's own mending takes for large enough are up to 2e-4 degrees smaller.
  constexpr double slack = 1e-3;
  mending.smallest_angle = std::max(0.0, options.smallest_angle - slack);
  mending.sparing = true;
  MendedTriangles mended = mend_triangles(nodes.mesh, places, surface, mending, execution);
  result.report.mending = mended.report;
  nodes.mesh = std::move(mended.mesh);
  // Not by an offset along the normals, as after a fit, which takes some hundredths of a degree
  // from angles that are at the limit.
  scale_to_volume(nodes.mesh.triangles, volume, nodes.mesh.points, execution);
}

/// The distances of nodes at some places that a density wants, in any unit.
std::vector<double> spacings_at(const std::vector<MeshPlace>& places, const MappedSurface& surface,
                                const std::vector<double>& densities) {
  std::vector<double> spacings;
  if (densities.empty()) return spacings;
  spacings.reserve(places.size());
  for (const MeshPlace& place : places) {
    spacings.push_back(1.0 / std::sqrt(value_at(surface.mesh(), densities, place)));
  }
  return spacings;
}

[[noreturn]] void refuse_shape(std::size_t nodes, int enough_nodes) {
  throw Error(
      ErrorCode::NumericalFailure,
      "The shape is too much for " + std::to_string(nodes) +
          " nodes: their mesh encloses no volume; " +
          (enough_nodes > 0 ? std::to_string(enough_nodes) + " would do." : "ask for many more."));
}

}  // namespace

SpaceNodes place_in_space(const Grain& grain, const MeshDistance* to_scan, int node_count,
                          const SpaceTessellationOptions& options,
                          const PlacementOptions& placement, double volume,
                          const Execution& execution) {
  check_placement_options(placement);
  if (!grain.mapped) {
    throw Error(ErrorCode::InvalidInput,
                "The grain is not mapped to the sphere; take the spherical parametrization.");
  }
  if (grain.is_level && to_scan == nullptr) {
    throw Error(ErrorCode::InvalidInput,
                "Only a level of the scan is mapped; give the distance to the scan, by which nodes "
                "are put on to it.");
  }
  execution.report(0.0, "Weighing the seeds");
  SpaceNodes result;
  const auto densities_for = [&](int count) {
    return densities_in_space(grain.mapped->mesh(), grain.map_curvatures, options.weighting, count);
  };
  const std::vector<double> densities = densities_for(node_count);
  const std::vector<std::int32_t>& order = grain.map.collapse_order;
  const bool relaxes = options.seeding.sampling == Sampling::Weighted;
  // A refinement needs the directions, which mending gives up, and mends by itself.
  const bool refines = placement.refinement.rounds > 0;
  const bool mends = relaxes && !refines;
  const MappedSurface* surface = &*grain.mapped;
  Laid best = lay(*surface,
                  tessellate_well(*surface, order, node_count, options, densities, volume,
                                  execution.part(0.05, 0.5)),
                  mends, execution.part(0.5, 0.52));
  std::optional<MappedSurface> rounder;
  double done = 0.52;
  for (const double weight : rounder_angle_weights) {
    if (!relaxes || !best.is_flawed()) break;
    const Execution part = execution.part(done, done + 0.14);
    done += 0.14;
    SphereMapOptions map_options;
    map_options.angle_weight = weight;
    try {
      const IndexedMesh& mesh = grain.mapped->mesh();
      SphereMap map = map_to_sphere(mesh, map_options, part.part(0.0, 0.1));
      MappedSurface another(mesh, std::move(map.directions), part.part(0.1, 0.1));
      SpaceTessellationOptions on_it = options;
      // Coarse levels jam first and hand it down; so many nodes at once would take minutes.
      if (node_count <= most_nodes_at_once) on_it.levels.coarsest_seeds = node_count;
      Laid other = lay(another,
                       tessellate_well(another, order, node_count, on_it, densities, volume,
                                       part.part(0.1, 0.95)),
                       mends, part.part(0.95, 1.0));
      if (!other.is_better_than(best)) continue;
      best = std::move(other);
      surface = &rounder.emplace(std::move(another));
      result.report.angle_weight = weight;
    } catch (const Error& error) {
      // What lies beyond a neck may become too small for doubles; the nodes at hand are valid.
      if (error.code() != ErrorCode::NumericalFailure) throw;
    }
  }
  if (relaxes) {
    spread_crowded(*surface, densities, options.relaxation, volume, mends, best,
                   result.report.relocated_seeds, execution.part(done, 0.8));
  }
  auto& [tessellation, flaws, from, repairs] = best.nodes;
  result.report.repairs = repairs;

  // Triangles that mending has parted make nobody's nodes too few.
  if (relaxes && (best.meeting > 0 || flaws.volume_loss > largest_volume_loss)) {
    // Twice as many until it does; a relaxation less strict says as much.
    constexpr int most_doublings = 4;
    SpaceTessellationOptions quick = options;
    int& iterations = quick.relaxation.maximum_iterations;
    iterations = std::min(iterations, 100);
    result.report.enough_nodes = too_many_nodes;
    for (int k = 1; k <= most_doublings && (node_count << k) <= 20000; ++k) {
      const int more = node_count << k;
      const SpaceTessellation trial = tessellate(*surface, order, more, quick, from,
                                                 densities_for(more), execution.part(0.8, 0.85));
      if (flaws_of(trial, volume, execution.part(0.8, 0.8)).any()) continue;
      result.report.enough_nodes = more;
      break;
    }
  }
  result.report.volume_loss = flaws.volume_loss;
  if (!(flaws.volume_loss < 1.0)) {
    refuse_shape(tessellation.seeds.size(), result.report.enough_nodes);
  }

  execution.report(0.85, "Placing the nodes");
  PlacedNodes& nodes = result.placed;
  MendedTriangles& mended = best.triangles;
  // A dozen nodes may enclose so little that mending takes it away.
  if (!(enclosed_volume(mended.mesh.points, mended.mesh.triangles) > 0.0)) {
    refuse_shape(tessellation.seeds.size(), result.report.enough_nodes);
  }
  // A refinement goes its own way, and who asks for other samplings gets these.
  const bool evens = relaxes && !refines && is_fitted(placement.kind);
  const bool changed = has_mended(mended.report) || evens;
  result.report.mending = mended.report;
  if (is_fitted(placement.kind)) {
    NormalFit fit = fit_mended(*surface, grain.is_level ? to_scan : nullptr, tessellation, mended,
                               volume, execution.part(0.87, 0.9));
    mended.mesh.points = std::move(fit.positions);
    result.report.fit = fit.report;
    if (evens) {
      EvenedEdges evened = even_edges(mended.mesh, spacings_at(mended.places, *surface, densities),
                                      EdgeEveningOptions(), execution.part(0.9, 0.9));
      mended.mesh.points = std::move(evened.positions);
      scale_to_volume(mended.mesh.triangles, volume, mended.mesh.points, execution);
      result.report.evening = evened.report;
    }
  } else if (grain.is_level) {
    for (Vector3& point : mended.mesh.points) point = to_scan->nearest_point(point);
  }
  nodes.mesh = std::move(mended.mesh);
  if (refines) {
    refine_in_space(*surface, grain.is_level ? to_scan : nullptr, tessellation,
                    placement.refinement, volume, result, execution.part(0.9, 1.0));
  }
  const bool for_contacts = placement.kind == NodePlacement::Contact;
  if (for_contacts) {
    nodes.mesh.points = fit_to_contacts(nodes.mesh, grain.mesh, to_scan, placement.contact_radius,
                                        execution.part(0.95, 1.0));
  }
  result.report.self_intersections =
      self_intersections(nodes.mesh, execution.part(1.0, 1.0)).size();
  if (result.report.self_intersections > 0 && placement.refuse_self_intersections) {
    throw Error(ErrorCode::NumericalFailure,
                "In the mesh with " + std::to_string(tessellation.seeds.size()) + " nodes " +
                    std::to_string(result.report.self_intersections) +
                    " pairs of triangles meet each other, which the options refuse; " +
                    (result.report.enough_nodes > 0
                         ? std::to_string(result.report.enough_nodes) + " nodes would do."
                         : std::string("ask for more nodes, or allow it.")));
  }
  nodes.directions.reserve(nodes.mesh.points.size());
  for (const Vector3& point : nodes.mesh.points) {
    const double radius = point.norm();
    nodes.radii.push_back(radius);
    nodes.directions.push_back(radius > 0.0 ? Vector3(point / radius) : Vector3::UnitX());
  }
  // A node that was moved or relocated has no power cell, so all get their share of the triangles.
  nodes.cell_areas = changed || refines || for_contacts ? vertex_areas(nodes.mesh)
                                                        : std::move(tessellation.cell_areas);
  result.relaxation = std::move(tessellation.report);
  return result;
}

}  // namespace wscvt
