// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_parameters.h"

#include <limits>

namespace wscvt::filter {

FilterParameter node_count_parameter() {
  FilterParameter parameter = option_parameter(
      "NodeCount", RemeshOptions().node_count, node_count_option, "Number of nodes",
      "Vertices of the result, exactly. Flat triangles lose about 660/N % of the volume, unless "
      "nodes are placed by least squares.");
  parameter.required = true;
  return parameter;
}

FilterParameter sampling_parameter() {
  return table_parameter(
      "Sampling", RemeshOptions().seeding.sampling, "Sampling",
      "Where the nodes' directions come from. All but the first are for comparison and ignore the "
      "weighting.");
}

FilterParameter weighting_parameter() {
  return table_parameter("Weighting", RemeshOptions().weighting.kind, "Weighting",
                         "How large the nodes' cells are, so where nodes stand closer together.");
}

FilterParameter curvature_alpha_parameter() {
  return option_parameter(
      "CurvatureAlpha", RemeshOptions().weighting.curvature_alpha, curvature_alpha_option,
      "Curvature strength alpha",
      "Strength of WSCVT-C: 0 ignores curvature, larger gathers nodes at edges and corners, "
      "negative keeps them away.");
}

FilterParameter metric_parameter() {
  return table_parameter(
      "Metric", RemeshOptions().relaxation.metric, "Metric",
      "Where the cells are made centroidal; Surface gives the most even triangles.");
}

FilterParameter seed_start_parameter() {
  return table_parameter("SeedStart", RemeshOptions().seeding.start, "Start from",
                         "Where the nodes stand before they are relaxed.");
}

FilterParameter random_seed_parameter() {
  // Hosts know no larger whole numbers.
  const NumberOption<int> option = {random_seed_option.key,
                                    random_seed_option.subject,
                                    static_cast<int>(random_seed_option.minimum),
                                    std::numeric_limits<int>::max(),
                                    Ends::Both,
                                    random_seed_option.meaning};
  return option_parameter("RandomSeed", static_cast<int>(RemeshOptions().seeding.random_seed),
                          option, "Random seed",
                          "Of the random start only; the same seed, the same mesh.");
}

FilterParameter maximum_iterations_parameter() {
  return option_parameter("MaxIterations", RemeshOptions().relaxation.maximum_iterations,
                          maximum_iterations_option, "Largest number of iterations",
                          "Relaxation stops here at the latest.");
}

FilterParameter colour_by_quality_parameter() {
  return flag_parameter("ColorByQuality", false, "Color by quality",
                        "Colors the vertices by it: red lowest, green, blue highest.");
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
  return options.seeding.sampling == Sampling::Weighted
             ? short_label(label_of(options.weighting.kind))
             : short_label(label_of(options.seeding.sampling));
}

std::vector<std::string> all_nodes_names() {
  std::vector<std::string> names;
  for (const auto& row : enumerators<Sampling>()) {
    if (row.value != Sampling::Weighted) names.push_back(short_label(row.label));
  }
  for (const auto& row : enumerators<Weighting>()) names.push_back(short_label(row.label));
  return names;
}

}  // namespace wscvt::filter
