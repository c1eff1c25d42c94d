// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/nodes/node_placement.h"
#include "wscvt/scan/point_cloud.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/radial_samples.h"

namespace wscvt {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t block_size = 1024;

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

WeightingOptions weighting_options(const RemeshOptions& options) {
  WeightingOptions weighting;
  weighting.weighting =
      options.sampling == Sampling::Weighted ? options.weighting : Weighting::Constant;
  weighting.node_count = options.node_count;
  weighting.curvature_alpha = options.curvature_alpha;
  weighting.adaptive_exponent = options.adaptive_exponent;
  return weighting;
}

void check(const RemeshOptions& options) {
  require(options.node_count >= 4 && options.node_count <= maximum_node_count,
          "The number of nodes", std::to_string(options.node_count),
          "a whole number from 4 to " + std::to_string(maximum_node_count));
  require(options.degree >= 1 && options.degree <= 60, "The harmonic degree",
          std::to_string(options.degree), "a whole number from 1 to 60");
  require(options.fold_limit >= 0.0 && options.fold_limit < 1.0,
          "The largest folded share of the solid angle", format_percent(options.fold_limit),
          "at least 0 % and less than 100 %");
  check_weighting_options(weighting_options(options));
  require_enumerator(options.sampling, Sampling::Icosahedron, "The sampling");
  require_enumerator(options.weighting, Weighting::ErrorAdaptive, "The weighting");
  require_enumerator(options.curvature_source, CurvatureSource::QuadricFit, "The curvature source");
  require_enumerator(options.placement, NodePlacement::LeastSquares, "The placement of the nodes");
  require_enumerator(options.seed_start, SeedStart::Random, "The start of the seeds");
  check_multilevel_options(options.levels);
  check_relaxation_options(options.relaxation);
  require_enumerator(options.error_target.measure, ErrorMeasure::Distance,
                     "The measure of the error target");
  require(options.error_target.percent >= 0.0 && std::isfinite(options.error_target.percent),
          "The error target", format_number(options.error_target.percent),
          "a positive number of per cent, or 0 for none");
  require(options.error_target.largest_node_count >= 4 &&
              options.error_target.largest_node_count <= maximum_node_count,
          "The largest number of nodes to try",
          std::to_string(options.error_target.largest_node_count),
          "a whole number from 4 to " + std::to_string(maximum_node_count));
  if (options.error_target.percent > 0.0 &&
      (options.sampling == Sampling::EqualAngle || options.sampling == Sampling::Icosahedron)) {
    throw Error(ErrorCode::InvalidInput,
                "An error target needs a sampling with any number of nodes; take the weighted one "
                "or the Fibonacci lattice, or set the target to 0.");
  }
  check_distance_options(options.distance_sampling);
  check_refinement_options(options.refinement);
  if (options.refinement.rounds > 0 && options.placement != NodePlacement::LeastSquares) {
    throw Error(ErrorCode::InvalidInput,
                "Refinement takes the nodes off the surface they were to be placed on; place them "
                "by least squares, or set the rounds of the refinement to 0.");
  }
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

/// A scan made ready: all that does not depend on the number of nodes. The grain has equivalent
/// radius 1 about the origin, wherever and however large it was, so that tolerances and table
/// floors mean the same for every scan.
struct PreparedGrain {
  RemeshResult report;  ///< what is known before there is a mesh; original and fit in grain units
  double unit = 1.0;    ///< length of the input per length here
  IndexedMesh mesh;
  std::unique_ptr<const RadialSurface> surface;
  std::optional<CurvatureSamples>
      curvatures;       ///< of the scan itself, when the weighting reads them
  bool is_scan = true;  ///< not a formula, whose own points are exact

  /// Distances to the mesh and rays at it. Both take longer to make ready than to ask on a dense
  /// scan, so they are made once, at the first use, for all node counts that are tried.
  const MeshDistance& distance() const {
    if (!made_distance) made_distance = std::make_unique<const MeshDistance>(mesh);
    return *made_distance;
  }
  const MeshSurface& rays(const Execution& execution) const {
    if (!made_rays) {
      made_rays = std::make_unique<const MeshSurface>(mesh, Vector3::Zero(), 1.0, execution);
    }
    return *made_rays;
  }
  mutable std::unique_ptr<const MeshDistance> made_distance = nullptr;
  mutable std::unique_ptr<const MeshSurface> made_rays = nullptr;
};

PreparedGrain prepare(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  RemeshResult result;
  CheckedMesh checked = check_mesh(std::move(scan), options.check, execution.part(0.0, 0.5));
  result.input = checked.report;
  result.centre = checked.report.centroid;
  const double unit = checked.report.equivalent_radius;
  IndexedMesh& grain = checked.mesh;
  execution.parallel_for(grain.points.size(), block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      grain.points[i] = (grain.points[i] - result.centre) / unit;
    }
  });

  execution.report(0.5, "Looking for folds");
  const RadialSamples samples = radial_samples(grain, execution.part(0.5, 0.6));
  result.folded_share = samples.folded_share;
  if (result.folded_share >= 1.0) {
    throw Error(
        ErrorCode::NotStarShaped,
        "The volume centroid of the grain lies outside of it, or on its surface, so that no "
        "radius in each direction describes it; cut the grain into rounder pieces and "
        "remesh each on its own.");
  }
  if (result.folded_share > options.fold_limit) {
    throw Error(ErrorCode::NotStarShaped,
                "Seen from its centre the grain folds over itself: sheets beyond the first fill " +
                    format_percent(result.folded_share) +
                    " of the solid angle, above the limit of " +
                    format_percent(options.fold_limit) +
                    ". A radius in each direction cannot describe it: remove inner surfaces and "
                    "attached pieces from the scan, or raise the limit and check the result.");
  }
  execution.report(0.6, "Fitting harmonics");
  HarmonicFit fit = fit_harmonics(samples.directions, samples.radii, samples.weights,
                                  options.degree, execution.part(0.6, 0.9));
  result.fit = fit.report;
  result.fit.residual *= unit;
  result.fit.smallest_radius *= unit;
  result.coefficients = fit.surface.coefficients();
  for (double& coefficient : result.coefficients) coefficient *= unit;

  execution.report(0.9, "Measuring the scan");
  result.original = describe_shape(grain, execution.part(0.9, 1.0));
  result.original_quality = measure_quality(grain, execution);
  std::optional<CurvatureSamples> curvatures;
  if (options.weighting == Weighting::Curvature &&
      options.curvature_source == CurvatureSource::QuadricFit) {
    curvatures = scan_curvatures(grain, samples, execution);
  }
  return {std::move(result), unit, std::move(grain),
          std::make_unique<HarmonicSurface>(std::move(fit.surface)), std::move(curvatures)};
}

/// A surface in units of `unit`.
class ScaledSurface : public RadialSurface {
 public:
  ScaledSurface(const RadialSurface& surface, double unit) : surface_(surface), unit_(unit) {}

  void evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                RadialJet* jets) const override {
    surface_.evaluate(directions, count, derivatives, jets);
    for (std::size_t i = 0; i < count; ++i) {
      jets[i].radius /= unit_;
      jets[i].gradient /= unit_;
      jets[i].hessian /= unit_;
    }
  }

 private:
  const RadialSurface& surface_;
  double unit_;
};

PreparedGrain prepare(const RadialSurface& surface, const Execution& execution) {
  // An icosahedron cut in 64 parts: 40,962 points, whose chords lose 0.02 % of the volume.
  constexpr int frequency = 64;
  RemeshResult result;
  const SurfaceIntegrals integrals = integrate(surface, execution);
  const double unit = std::cbrt(3.0 * integrals.volume / (4.0 * pi));
  auto scaled = std::make_unique<ScaledSurface>(surface, unit);
  IndexedMesh dense;
  dense.points = subdivided_icosahedron(frequency);
  dense.triangles = SphereTriangulation(dense.points).triangles();
  const std::vector<double> radii = scaled->radii(dense.points, execution);
  for (std::size_t i = 0; i < radii.size(); ++i) dense.points[i] *= radii[i];
  result.input.volume = integrals.volume;
  result.input.area = integrals.area;
  result.input.centroid = integrals.centroid;
  result.input.equivalent_radius = unit;
  result.input.components = 1;
  result.original = describe_shape(dense, execution);
  result.original.volume = 4.0 * pi / 3.0;
  result.original.area = integrals.area / (unit * unit);
  result.original.sphericity = 4.0 * pi / result.original.area;
  result.original_quality = measure_quality(dense, execution);
  return {std::move(result), unit, std::move(dense), std::move(scaled), std::nullopt, false};
}

std::vector<Vector3> unweighted_seeds(const RemeshOptions& options) {
  switch (options.sampling) {
    case Sampling::EqualAngle:
      return nearest_equal_angle_grid(options.node_count);
    case Sampling::Icosahedron:
      return nearest_subdivided_icosahedron(options.node_count);
    case Sampling::Fibonacci:
    case Sampling::Weighted:
      break;
  }
  return fibonacci_lattice(options.node_count);
}

RelaxationResult relax_seeds(const PreparedGrain& grain, const RemeshOptions& options,
                             const Execution& execution) {
  execution.report(0.0, "Weighing the seeds");
  const SurfaceSeedModel model(*grain.surface, weighting_options(options),
                               grain.curvatures ? &*grain.curvatures : nullptr, execution);
  if (options.sampling != Sampling::Weighted) {
    RelaxationOptions none = options.relaxation;
    none.maximum_iterations = 0;
    return relax(unweighted_seeds(options), model, none, execution);
  }
  MultilevelOptions levels = options.levels;
  if (options.seed_start != SeedStart::Multilevel) levels.coarsest_seeds = options.node_count;
  const int coarsest = level_sizes(options.node_count, levels.coarsest_seeds).front();
  return relax_multilevel(start_seeds(options, model, coarsest, execution), options.node_count,
                          model, options.relaxation, levels, execution.part(0.1, 1.0));
}

/// The remesh in the grain's units and about the origin.
struct PlacedNodes {
  std::vector<Vector3> directions;
  std::vector<double> radii;
  std::vector<double> cell_areas;
  std::vector<double> curvatures;
  IndexedMesh mesh;
  RefinementReport refinement;

  void put_on_radii() {
    mesh.points.resize(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) mesh.points[i] = radii[i] * directions[i];
  }
};

void share_areas(const IndexedMesh& mesh, std::vector<double>& areas) {
  areas.assign(mesh.points.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.points[t[0]];
    const double area = 0.5 * (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).norm();
    for (const std::int32_t v : t) areas[v] += area / 3.0;
  }
}

PlacedNodes place_nodes(const PreparedGrain& grain, RelaxationResult& relaxed,
                        const RemeshOptions& options, const Execution& execution) {
  // Points at which the least-squares radii read the scan.
  constexpr std::size_t fit_samples = 60000;
  execution.report(0.0, "Placing the nodes");
  PlacedNodes nodes;
  nodes.directions = std::move(relaxed.seeds);
  nodes.cell_areas = std::move(relaxed.cell_areas);
  SphereTriangulation& triangulation = relaxed.triangulation;
  const std::vector<RadialJet> jets =
      grain.surface->jets(nodes.directions, Derivatives::First, execution);
  nodes.radii.resize(jets.size());
  for (std::size_t i = 0; i < jets.size(); ++i) {
    nodes.radii[i] = jets[i].radius;
    if (options.relaxation.metric == RelaxationMetric::Sphere) {
      nodes.cell_areas[i] *= area_element(jets[i]);
    }
  }
  if (options.placement == NodePlacement::OriginalMesh && grain.is_scan) {
    nodes.radii = grain.rays(execution).radii(nodes.directions, execution);
  }
  nodes.put_on_radii();
  triangulation.restore_surface_delaunay(nodes.directions, nodes.mesh.points, execution);
  nodes.mesh.triangles = triangulation.triangles();
  if (options.placement == NodePlacement::LeastSquares) {
    const MeshSurface& scan = grain.rays(execution);
    nodes.radii =
        least_squares_radii(nodes.directions, nodes.mesh.triangles, scan, fit_samples, execution);
    nodes.put_on_radii();
    if (options.refinement.rounds > 0) {
      RefinedNodes refined = refine_nodes(std::move(nodes.mesh.points), std::move(triangulation),
                                          scan, options.refinement, execution.part(0.1, 1.0));
      nodes.mesh = {std::move(refined.positions), refined.triangulation.triangles()};
      nodes.refinement = std::move(refined.report);
    }
    scale_to_volume(nodes.mesh.triangles, grain.report.original.volume, nodes.mesh.points,
                    execution);
    for (std::size_t i = 0; i < nodes.radii.size(); ++i) {
      nodes.radii[i] = nodes.mesh.points[i].norm();
      nodes.directions[i] = nodes.mesh.points[i] / nodes.radii[i];
    }
    if (options.refinement.rounds > 0) share_areas(nodes.mesh, nodes.cell_areas);
  }
  if (options.node_curvatures) {
    const std::vector<RadialJet> curved =
        grain.surface->jets(nodes.directions, Derivatives::Second, execution);
    for (std::size_t i = 0; i < curved.size(); ++i) {
      const PrincipalCurvatures k = principal_curvatures(curved[i], nodes.directions[i]);
      nodes.curvatures.push_back(std::max(std::abs(k.maximum), std::abs(k.minimum)));
    }
  }
  return nodes;
}

void scale(ShapeDescriptors& descriptors, double unit, const Vector3& centre) {
  descriptors.volume *= unit * unit * unit;
  descriptors.area *= unit * unit;
  descriptors.centroid = centre + unit * descriptors.centroid;
  descriptors.inertia_semi_axes *= unit;
  descriptors.inertia_tensor *= std::pow(unit, 5);
}

void scale(MeshQuality& quality, double unit) {
  quality.edge_length.mean *= unit;
  quality.edge_length.standard_deviation *= unit;
  quality.edge_length.minimum *= unit;
  quality.edge_length.maximum *= unit;
}

void scale(OneSidedDistance& distance, double unit) {
  distance.maximum *= unit;
  distance.root_mean_square *= unit;
  distance.mean *= unit;
}

void scale(MeshDistances& distances, double unit) {
  scale(distances.to_reference, unit);
  scale(distances.from_reference, unit);
  distances.hausdorff *= unit;
  distances.root_mean_square *= unit;
}

void scale(RefinementReport& refinement, double unit) {
  refinement.start_distance *= unit;
  for (RefinementStep& step : refinement.history) step.distance *= unit;
}

void add_warnings(RemeshResult& result) {
  const auto warn = [&](const std::string& sentence) { result.warnings.push_back(sentence); };
  if (result.folded_share > fold_warning_limit) {
    warn("The scan folds over itself: sheets beyond the first fill " +
         format_percent(result.folded_share) +
         " of the solid angle seen from its centre; there the outermost was taken. Check the "
         "result against the scan.");
  }
  if (result.input.components > 1) {
    warn("The scan has " + std::to_string(result.input.components) +
         " separate parts; only the largest was remeshed.");
  }
  if (result.input.genus > 0) {
    warn("The scan has " + std::to_string(result.input.genus) +
         (result.input.genus == 1 ? " hole" : " holes") +
         " through it (genus), which the remesh closes.");
  }
  if (result.fit.degree < result.fit.requested_degree) {
    const std::string lowered = "The harmonic degree was lowered from " +
                                std::to_string(result.fit.requested_degree) + " to " +
                                std::to_string(result.fit.degree);
    switch (result.fit.limit) {
      case DegreeLimit::None:
      case DegreeLimit::Points:
        warn(lowered + ", which is what the scan's " + std::to_string(result.fit.points) +
             " points can carry.");
        break;
      case DegreeLimit::Condition:
        warn(lowered +
             ", because seen from its centre the scan's points are spread too unevenly "
             "for more; spread them evenly over the surface first.");
        break;
      case DegreeLimit::Radius:
        warn(lowered +
             ", because above it the series is not positive everywhere: the grain is "
             "long, flat or sharp.");
    }
  }
  const double misfit = result.fit.residual / result.input.equivalent_radius;
  if (misfit > residual_warning_limit) {
    warn("The fitted series misses the scan by " + format_percent(misfit) +
         " of the equivalent radius (rms). " +
         (result.fit.limit == DegreeLimit::None ? "Raise the harmonic degree, or place" : "Place") +
         " the nodes on the original mesh or by least squares, which follow the scan itself.");
  }
  if (result.options.sampling != Sampling::Weighted) {
    const auto nodes = static_cast<int>(result.mesh.n_vertices());
    if (nodes != result.options.node_count) {
      warn("This sampling has no form with " + std::to_string(result.options.node_count) +
           " nodes; the nearest, with " + std::to_string(nodes) + ", was used.");
    }
  } else if (result.relaxation.outcome == RelaxationOutcome::Settled) {
    warn("The seeds came to rest with the cells' areas still spread by " +
         format_percent(result.relaxation.history.back().area_spread) +
         " about their targets; more nodes follow the surface more evenly.");
  } else if (result.relaxation.outcome == RelaxationOutcome::Stuck) {
    warn("The relaxation stopped after " + std::to_string(result.relaxation.iterations) +
         " iterations, because a further step would have torn the triangulation; the result keeps "
         "every promise but may be less even. Another start of the seeds may go further.");
  } else if (result.relaxation.outcome == RelaxationOutcome::IterationLimit) {
    warn("The relaxation stopped at its limit of " + std::to_string(result.relaxation.iterations) +
         " iterations before it converged; raise the limit for the last bit of evenness.");
  }
  if (result.relaxation.weight_scale < 1.0) {
    warn("The differences between the weights were scaled by " +
         format_number(result.relaxation.weight_scale, 3) +
         ", because seeds would have lost their cells; " +
         (result.options.weighting == Weighting::Curvature
              ? "lower the curvature exponent alpha."
              : "ask for more nodes, or for another weighting."));
  }
  if (result.search && !result.search->met) {
    warn("No number of nodes up to " + std::to_string(result.search->node_count) +
         " meets the error target of " +
         format_percent(0.01 * result.options.error_target.percent) +
         "; this is the result with that many. Allow more nodes, or a larger error.");
  }
}

RemeshResult remesh_prepared(const PreparedGrain& grain, const RemeshOptions& options,
                             const Execution& execution) {
  RemeshResult result = grain.report;
  result.options = options;
  // Samplings that are not relaxed are cut into cells on the sphere.
  if (options.sampling != Sampling::Weighted) {
    result.options.relaxation.metric = RelaxationMetric::Sphere;
  }
  RelaxationResult relaxed = relax_seeds(grain, result.options, execution.part(0.0, 0.7));
  PlacedNodes nodes = place_nodes(grain, relaxed, result.options, execution.part(0.7, 0.9));

  execution.report(0.9, "Measuring the remesh");
  result.remesh = describe_shape(nodes.mesh, execution.part(0.9, 0.92));
  result.quality = measure_quality(nodes.mesh, execution);
  if (options.distances) {
    const Execution measuring = execution.part(0.92, 0.98);
    measuring.report(0.0, "Measuring distances");
    result.distances = measure_distances(nodes.mesh, grain.mesh, grain.distance(),
                                         options.distance_sampling, measuring);
    result.vertex_distances = grain.distance().distances(nodes.mesh.points, execution);
  }

  const double unit = grain.unit;
  scale(result.original, unit, result.centre);
  scale(result.remesh, unit, result.centre);
  scale(result.original_quality, unit);
  scale(result.quality, unit);
  scale(nodes.refinement, unit);
  if (result.distances) scale(*result.distances, unit);
  for (Vector3& point : nodes.mesh.points) point = result.centre + unit * point;
  for (double& radius : nodes.radii) radius *= unit;
  for (double& area : nodes.cell_areas) area *= unit * unit;
  for (double& curvature : nodes.curvatures) curvature /= unit;
  for (double& distance : result.vertex_distances) distance *= unit;
  result.mesh = to_mesh(nodes.mesh);
  result.directions = std::move(nodes.directions);
  result.radial_distances = std::move(nodes.radii);
  result.cell_areas = std::move(nodes.cell_areas);
  result.curvatures = std::move(nodes.curvatures);
  result.refinement = std::move(nodes.refinement);
  result.relaxation = std::move(relaxed.report);
  return result;
}

RemeshResult remesh_to_target(const PreparedGrain& grain, const RemeshOptions& options,
                              const Execution& execution) {
  const ErrorTarget& target = options.error_target;
  // The result with the smallest node count that met the target, or with the largest tried.
  RemeshResult best;
  bool best_meets = false;
  int trials = 0;
  const auto error = [&](int node_count) {
    RemeshOptions trial = options;
    trial.node_count = node_count;
    trial.distances = options.distances || target.measure == ErrorMeasure::Distance;
    // How many trials there will be is not known; about ten are usual.
    const double begin = 1.0 - std::pow(0.85, trials);
    const double end = 1.0 - std::pow(0.85, ++trials);
    RemeshResult result;
    try {
      result = remesh_prepared(grain, trial, execution.part(begin, end));
    } catch (const Error& failure) {
      // So few nodes that they do not surround the centre.
      if (failure.code() != ErrorCode::NumericalFailure) throw;
      return std::numeric_limits<double>::infinity();
    }
    const double percent_off = error_percent(result, target.measure);
    const bool meets = percent_off <= target.percent;
    const int best_count = static_cast<int>(best.mesh.n_vertices());
    if (meets ? !best_meets || node_count < best_count : !best_meets && node_count > best_count) {
      best = std::move(result);
      best_meets = meets;
    }
    return percent_off;
  };
  NodeCountSearch search =
      smallest_node_count(target.percent, options.node_count, 4, target.largest_node_count, error);
  if (best.mesh.n_vertices() == 0) {
    throw Error(ErrorCode::NumericalFailure,
                "None of the node counts tried could be remeshed; allow more nodes.");
  }
  best.search = std::move(search);
  return best;
}

RemeshResult finish(const PreparedGrain& grain, const RemeshOptions& options,
                    const Execution& execution) {
  RemeshResult result = options.error_target.percent > 0.0
                            ? remesh_to_target(grain, options, execution)
                            : remesh_prepared(grain, options, execution);
  add_warnings(result);
  execution.report(1.0, "Done");
  return result;
}

}  // namespace

double error_percent(const RemeshResult& result, ErrorMeasure measure) {
  const ShapeDescriptors& a = result.remesh;
  const ShapeDescriptors& b = result.original;
  switch (measure) {
    case ErrorMeasure::Volume:
      return std::abs(relative_error_percent(a.volume, b.volume));
    case ErrorMeasure::Area:
      return std::abs(relative_error_percent(a.area, b.area));
    case ErrorMeasure::Sphericity:
      return std::abs(relative_error_percent(a.sphericity, b.sphericity));
    case ErrorMeasure::Inertia:
      return inertia_error_percent(a, b);
    case ErrorMeasure::Distance:
      break;
  }
  if (!result.distances) {
    throw Error(ErrorCode::InvalidInput,
                "The result holds no distances; ask for them in the options of the remesh.");
  }
  return 100.0 * result.distances->root_mean_square / result.input.equivalent_radius;
}

RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options, const Execution& execution) {
  check(options);
  const std::size_t points = scan.points.size();
  const bool without_faces = scan.triangles.empty() && points > 0;
  if (without_faces) scan = mesh_of_points(std::move(scan.points));
  const std::size_t different = scan.points.size();
  PreparedGrain grain = prepare(std::move(scan), options, execution.part(0.0, 0.3));
  if (without_faces) {  // what was given, not what was made of it
    grain.report.input.input_vertices = points;
    grain.report.input.input_faces = 0;
    grain.report.input.welded_vertices = points - different;
  }
  return finish(grain, options, execution.part(0.3, 1.0));
}

RemeshResult remesh(const RadialSurface& surface, const RemeshOptions& options,
                    const Execution& execution) {
  check(options);
  RemeshOptions of_surface = options;
  of_surface.curvature_source = CurvatureSource::Series;  // there is no scan to read it off
  return finish(prepare(surface, execution.part(0.0, 0.3)), of_surface, execution.part(0.3, 1.0));
}

RemeshResult remesh(const Mesh& scan, const RemeshOptions& options, const Execution& execution) {
  return remesh(to_indexed(scan), options, execution);
}

}  // namespace wscvt
