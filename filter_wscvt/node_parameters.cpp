// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_parameters.h"

#include <limits>

namespace wscvt::filter {

FilterParameter node_count_parameter() {
  return integer_parameter(
      "NodeCount", RemeshOptions().node_count, 4, maximum_node_count, "Number of nodes",
      "Vertices of the result, 4 to 1000000. The result has exactly this many, and twice as "
      "many faces less four. The chords lose about 660/N % of the volume, unless the nodes are "
      "fitted by least squares.");
}

FilterParameter sampling_parameter() {
  return choice_parameter(
      "Sampling", static_cast<int>(RemeshOptions().seeding.sampling),
      {"Weighted Voronoi", "Fibonacci lattice", "Equal-angle grid", "Icosahedron"}, "Sampling",
      "Where the directions of the nodes come from. Weighted Voronoi: the method, with the "
      "weighting below. The others are there to be compared with and ignore it: a Fibonacci "
      "lattice, a grid of equal angles and a subdivided icosahedron, the last two with the number "
      "of nodes nearest to the one asked for.");
}

FilterParameter weighting_parameter() {
  return choice_parameter(
      "Weighting", static_cast<int>(RemeshOptions().weighting.kind),
      {"Constant", "WSCVT-D (radial distance)", "WSCVT-C (curvature)", "Area", "Error-adaptive"},
      "Weighting",
      "What decides how large the cell of a node is. Constant: equal solid angles. WSCVT-D: "
      "smaller solid angles far from the centroid, so even triangles. WSCVT-C: more nodes "
      "where the surface bends. Area: equal surface areas. Error-adaptive: nodes where flat "
      "triangles err most.");
}

FilterParameter curvature_alpha_parameter() {
  return real_parameter(
      "CurvatureAlpha", RemeshOptions().weighting.curvature_alpha, -3, 3,
      "Curvature strength alpha",
      "Strength of the curvature weighting (WSCVT-C only), -3 to 3, no unit. 0 ignores "
      "curvature, larger gathers more nodes at edges and corners, negative keeps them away.");
}

FilterParameter metric_parameter() {
  return choice_parameter(
      "Metric", static_cast<int>(RemeshOptions().relaxation.metric), {"Sphere", "Surface"},
      "Metric",
      "Sphere: cells are centroidal on the unit sphere, the published method. Surface: on "
      "the grain's surface itself, which gives the most even triangles in about the same time.");
}

FilterParameter seed_start_parameter() {
  return choice_parameter(
      "SeedStart", static_cast<int>(RemeshOptions().seeding.start),
      {"Multilevel", "Warped lattice", "Random"}, "Start from",
      "Multilevel: a few hundred nodes are relaxed, subdivided and relaxed again; fastest "
      "and most even. Warped lattice: all nodes in a Fibonacci lattice adapted to the "
      "weighting. Random: directions drawn with the random seed; needs many iterations.");
}

FilterParameter random_seed_parameter() {
  return integer_parameter("RandomSeed", static_cast<int>(RemeshOptions().seeding.random_seed), 0,
                           std::numeric_limits<int>::max(), "Random seed",
                           "Start of the random directions, 0 to 2147483647; has no effect unless "
                           "the start is random. The same seed gives the same mesh.");
}

FilterParameter maximum_iterations_parameter() {
  return integer_parameter(
      "MaxIterations", RemeshOptions().relaxation.maximum_iterations, 0, 100000,
      "Largest number of iterations",
      "Relaxation stops here if it has not converged before, 0 to 100000; the log says which.");
}

FilterParameter colour_by_quality_parameter() {
  return flag_parameter("ColorByQuality", false, "Color by quality",
                        "Colors the vertices of the result by their quality, from red (lowest) "
                        "through green to blue (highest).");
}

RemeshOptions read_node_options(const CheckedValues& values) {
  RemeshOptions options;
  options.node_count = values.whole("NodeCount");
  options.seeding.sampling = values.choice<Sampling>("Sampling");
  options.weighting.kind = values.choice<Weighting>("Weighting");
  options.weighting.curvature_alpha = values.real("CurvatureAlpha");
  options.relaxation.metric = values.choice<RelaxationMetric>("Metric");
  options.seeding.start = values.choice<SeedStart>("SeedStart");
  options.seeding.random_seed = static_cast<std::uint64_t>(values.whole("RandomSeed"));
  options.relaxation.maximum_iterations = values.whole("MaxIterations");
  return options;
}

std::vector<std::string> quality_names() {
  return {"Radial distance", "Curvature", "Cell area", "Distance to the original"};
}

void request_quality(RemeshOptions& options, VertexQuality quality) {
  if (quality == VertexQuality::Curvature) options.measures.node_curvatures = true;
  if (quality == VertexQuality::OriginalDistance) options.measures.distances = true;
}

const std::vector<double>& quality_values(const RemeshResult& result, VertexQuality quality) {
  switch (quality) {
    case VertexQuality::Curvature:
      return result.curvatures;
    case VertexQuality::CellArea:
      return result.cell_areas;
    case VertexQuality::OriginalDistance:
      return result.vertex_distances;
    case VertexQuality::RadialDistance:
      break;
  }
  return result.radial_distances;
}

std::string nodes_name(const RemeshOptions& options) {
  switch (options.seeding.sampling) {
    case Sampling::Fibonacci:
      return "Fibonacci";
    case Sampling::EqualAngle:
      return "equal-angle";
    case Sampling::Icosahedron:
      return "icosahedron";
    case Sampling::Weighted:
      break;
  }
  switch (options.weighting.kind) {
    case Weighting::Constant:
      return "Constant";
    case Weighting::RadialDistance:
      return "WSCVT-D";
    case Weighting::Curvature:
      return "WSCVT-C";
    case Weighting::Area:
      return "Area";
    case Weighting::ErrorAdaptive:
      return "Error-adaptive";
  }
  return "unknown weighting";
}

std::vector<std::string> all_nodes_names() {
  std::vector<std::string> names;
  RemeshOptions options;
  for (const Sampling sampling :
       {Sampling::Fibonacci, Sampling::EqualAngle, Sampling::Icosahedron}) {
    options.seeding.sampling = sampling;
    names.push_back(nodes_name(options));
  }
  options.seeding.sampling = Sampling::Weighted;
  for (const Weighting weighting :
       {Weighting::Constant, Weighting::RadialDistance, Weighting::Curvature, Weighting::Area,
        Weighting::ErrorAdaptive}) {
    options.weighting.kind = weighting;
    names.push_back(nodes_name(options));
  }
  return names;
}

}  // namespace wscvt::filter
