// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "wscvt/curvature.h"
#include "wscvt/error.h"
#include "wscvt/mesh_surface.h"
#include "wscvt/radial_samples.h"
#include "wscvt/sphere_sampling.h"

namespace wscvt {

namespace {

constexpr std::size_t block_size = 1024;

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
  return text;
}

void require(bool fits, const std::string& what, const std::string& value,
             const std::string& range) {
  if (!fits) {
    throw Error(ErrorCode::InvalidInput, what + " is " + value + "; give " + range + ".");
  }
}

template <class Enumeration>
void require_enumerator(Enumeration value, Enumeration last, const std::string& what) {
  const int number = static_cast<int>(value);
  require(number >= 0 && number <= static_cast<int>(last), what, "number " + std::to_string(number),
          "a number from 0 to " + std::to_string(static_cast<int>(last)));
}

void check(const RemeshOptions& options) {
  require(options.node_count >= 4 && options.node_count <= maximum_node_count,
          "The number of nodes", std::to_string(options.node_count),
          "a whole number from 4 to " + std::to_string(maximum_node_count));
  require(options.degree >= 1 && options.degree <= 60, "The harmonic degree",
          std::to_string(options.degree), "a whole number from 1 to 60");
  require(options.fold_limit >= 0.0 && options.fold_limit < 1.0,
          "The largest folded share of the solid angle", percent(options.fold_limit),
          "at least 0 % and less than 100 %");
  require(std::abs(options.curvature_alpha) <= 3.0, "The curvature exponent alpha",
          std::to_string(options.curvature_alpha), "a number from -3 to 3");
  require_enumerator(options.weighting, Weighting::ErrorAdaptive, "The weighting");
  require_enumerator(options.curvature_source, CurvatureSource::QuadricFit, "The curvature source");
  require_enumerator(options.placement, NodePlacement::OriginalMesh, "The placement of the nodes");
  require_enumerator(options.seed_start, SeedStart::Random, "The start of the seeds");
  require(options.levels.coarsest_seeds >= 4, "The size of the coarsest level",
          std::to_string(options.levels.coarsest_seeds), "4 or more");
  check_relaxation_options(options.relaxation);
  require_enumerator(options.relaxation.metric, RelaxationMetric::Surface,
                     "The metric of the relaxation");
}

bool can_be_triangulated(const std::vector<Vector3>& seeds) {
  try {
    SphereTriangulation triangulation(seeds);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::vector<Vector3> start_seeds(const RemeshOptions& options, const SurfaceSeedModel& model,
                                 int count, const Execution& execution) {
  if (options.seed_start == SeedStart::Random) {
    // Few random points often leave the centre outside; the next seeds of the same row are tried.
    for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
      std::vector<Vector3> seeds = random_directions(count, options.random_seed + attempt);
      if (count > 50 || can_be_triangulated(seeds)) return seeds;
    }
  }
  const int rows = std::clamp(static_cast<int>(2.0 * std::sqrt(count)), 64, 360);
  const auto density = [&](const std::vector<Vector3>& directions) {
    return model.number_densities(directions, execution);
  };
  std::vector<Vector3> seeds = warped_lattice(count, density, rows);
  if (count > 50 || can_be_triangulated(seeds)) return seeds;
  return fibonacci_lattice(count);
}

CurvatureSamples scan_curvatures(const IndexedMesh& scan, const RadialSamples& samples,
                                 const Execution& execution) {
  // The paper fits over one ring, which scans leave under-determined.
  constexpr int rings = 2;
  const std::vector<PrincipalCurvatures> of_vertices =
      quadric_fit_curvatures(scan, rings, execution);
  CurvatureSamples result;
  result.directions = samples.directions;
  result.weights = samples.weights;
  result.curvatures.reserve(samples.vertices.size());
  for (const std::int32_t vertex : samples.vertices) {
    result.curvatures.push_back(of_vertices[vertex]);
  }
  return result;
}

/// Nodes on `surface` along the relaxed seeds, in the surface's own units and about the origin.
struct Nodes {
  std::vector<double> radii;
  std::vector<double> cell_areas;
  std::vector<double> curvatures;
};

Nodes place_nodes(const RadialSurface& surface, const RelaxationResult& relaxed,
                  const RemeshOptions& options, const Execution& execution) {
  const std::vector<Vector3>& seeds = relaxed.seeds;
  const std::vector<RadialJet> jets = surface.jets(
      seeds, options.node_curvatures ? Derivatives::Second : Derivatives::First, execution);
  Nodes nodes;
  nodes.radii.resize(seeds.size());
  nodes.cell_areas = relaxed.cell_areas;
  if (options.node_curvatures) nodes.curvatures.resize(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    nodes.radii[i] = jets[i].radius;
    if (options.relaxation.metric == RelaxationMetric::Sphere) {
      nodes.cell_areas[i] *= area_element(jets[i]);
    }
    if (options.node_curvatures) {
      const PrincipalCurvatures k = principal_curvatures(jets[i], seeds[i]);
      nodes.curvatures[i] = std::max(std::abs(k.maximum), std::abs(k.minimum));
    }
  }
  return nodes;
}

void scale(ShapeDescriptors& descriptors, double unit, const Vector3& centre) {
  descriptors.volume *= unit * unit * unit;
  descriptors.area *= unit * unit;
  descriptors.centroid = centre + unit * descriptors.centroid;
  descriptors.inertia_semi_axes *= unit;
}

void scale(MeshQuality& quality, double unit) {
  quality.edge_length.mean *= unit;
  quality.edge_length.standard_deviation *= unit;
  quality.edge_length.minimum *= unit;
  quality.edge_length.maximum *= unit;
}

void add_warnings(RemeshResult& result) {
  const auto warn = [&](const std::string& sentence) { result.warnings.push_back(sentence); };
  if (result.folded_share > fold_warning_limit) {
    warn("The scan folds over itself on " + percent(result.folded_share) +
         " of the solid angle seen from its centre; there the outermost sheet was taken. Check the "
         "result against the scan.");
  }
  if (result.input.components > 1) {
    warn("The scan has " + std::to_string(result.input.components) +
         " separate parts; only the largest was remeshed.");
  }
  if (result.input.genus > 0) {
    warn("The scan has " + std::to_string(result.input.genus) +
         " holes through it (genus); the remesh closes them.");
  }
  if (result.fit.degree < result.fit.requested_degree) {
    warn("The harmonic degree was lowered from " + std::to_string(result.fit.requested_degree) +
         " to " + std::to_string(result.fit.degree) + ", which is what the scan's " +
         std::to_string(result.fit.points) + " points can carry.");
  }
  if (result.relaxation.settled) {
    warn("The seeds came to rest with the cells' areas still spread by " +
         percent(result.relaxation.history.back().area_spread) +
         " about their targets; more nodes follow the surface more evenly.");
  } else if (!result.relaxation.converged) {
    warn("The relaxation stopped at its limit of " + std::to_string(result.relaxation.iterations) +
         " iterations before it converged; raise the limit for the last bit of evenness.");
  }
  if (result.relaxation.weight_scale < 1.0) {
    warn("The differences between the weights were scaled by " +
         std::to_string(result.relaxation.weight_scale) +
         ", because seeds would have lost their cells; lower the curvature exponent alpha.");
  }
}

}  // namespace

RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  check(options);
  RemeshResult result;
  result.options = options;

  CheckedMesh checked = check_mesh(std::move(scan), options.check, execution.part(0.0, 0.15));
  result.input = checked.report;
  result.centre = checked.report.centroid;
  const double unit = checked.report.equivalent_radius;
  // From here on the grain has equivalent radius 1 about the origin, wherever and however large it
  // was, so that tolerances and table floors mean the same for every scan.
  IndexedMesh& grain = checked.mesh;
  execution.parallel_for(grain.points.size(), block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      grain.points[i] = (grain.points[i] - result.centre) / unit;
    }
  });

  execution.report(0.15, "Looking for folds");
  const RadialSamples samples = radial_samples(grain, execution.part(0.15, 0.2));
  result.folded_share = samples.folded_share;
  if (result.folded_share > options.fold_limit) {
    throw Error(ErrorCode::NotStarShaped,
                "Seen from its centre the grain folds over itself on " +
                    percent(result.folded_share) + " of the solid angle, above the limit of " +
                    percent(options.fold_limit) +
                    ". A radius in each direction cannot describe it: remove inner surfaces and "
                    "attached pieces from the scan, or raise the limit and check the result.");
  }
  execution.report(0.2, "Fitting harmonics");
  const HarmonicFit fit = fit_harmonics(samples.directions, samples.radii, samples.weights,
                                        options.degree, execution.part(0.2, 0.3));
  result.fit = fit.report;
  result.fit.residual *= unit;
  result.fit.smallest_radius *= unit;
  result.coefficients = fit.surface.coefficients();
  for (double& coefficient : result.coefficients) coefficient *= unit;

  execution.report(0.3, "Measuring the scan");
  result.original = describe_shape(grain, execution.part(0.3, 0.35));
  result.original_quality = measure_quality(grain);

  execution.report(0.35, "Weighing the seeds");
  std::optional<CurvatureSamples> curvatures;
  if (options.weighting == Weighting::Curvature &&
      options.curvature_source == CurvatureSource::QuadricFit) {
    curvatures = scan_curvatures(grain, samples, execution);
  }
  WeightingOptions weighting;
  weighting.weighting = options.weighting;
  weighting.node_count = options.node_count;
  weighting.curvature_alpha = options.curvature_alpha;
  const SurfaceSeedModel model(fit.surface, weighting, curvatures ? &*curvatures : nullptr,
                               execution);
  MultilevelOptions levels = options.levels;
  if (options.seed_start != SeedStart::Multilevel) levels.coarsest_seeds = options.node_count;
  const int coarsest = level_sizes(options.node_count, levels.coarsest_seeds).front();
  RelaxationResult relaxed =
      relax_multilevel(start_seeds(options, model, coarsest, execution), options.node_count, model,
                       options.relaxation, levels, execution.part(0.4, 0.9));

  execution.report(0.9, "Placing the nodes");
  Nodes nodes = place_nodes(fit.surface, relaxed, options, execution);
  if (options.placement == NodePlacement::OriginalMesh) {
    nodes.radii =
        MeshSurface(grain, Vector3::Zero(), 1.0, execution).radii(relaxed.seeds, execution);
  }
  IndexedMesh placed;
  placed.points.resize(relaxed.seeds.size());
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    placed.points[i] = nodes.radii[i] * relaxed.seeds[i];
  }
  relaxed.triangulation.restore_surface_delaunay(relaxed.seeds, placed.points, execution);
  placed.triangles = relaxed.triangulation.triangles();

  execution.report(0.95, "Measuring the remesh");
  result.remesh = describe_shape(placed, execution.part(0.95, 1.0));
  result.quality = measure_quality(placed);
  scale(result.original, unit, result.centre);
  scale(result.remesh, unit, result.centre);
  scale(result.original_quality, unit);
  scale(result.quality, unit);
  for (Vector3& point : placed.points) point = result.centre + unit * point;
  for (double& radius : nodes.radii) radius *= unit;
  for (double& area : nodes.cell_areas) area *= unit * unit;
  for (double& curvature : nodes.curvatures) curvature /= unit;
  result.mesh = to_mesh(placed);
  result.directions = std::move(relaxed.seeds);
  result.radial_distances = std::move(nodes.radii);
  result.cell_areas = std::move(nodes.cell_areas);
  result.curvatures = std::move(nodes.curvatures);
  result.relaxation = std::move(relaxed.report);
  add_warnings(result);
  execution.report(1.0, "Done");
  return result;
}

RemeshResult remesh(const Mesh& scan, const RemeshOptions& options, const Execution& execution) {
  return remesh(to_indexed(scan), options, execution);
}

}  // namespace wscvt
