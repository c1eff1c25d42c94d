// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "wscvt/error.h"

namespace wscvt::filter {

namespace {

FilterParameter number(std::string name, ParameterKind kind, double default_value, double minimum,
                       double maximum, std::string label, std::string tooltip) {
  FilterParameter parameter;
  parameter.name = std::move(name);
  parameter.kind = kind;
  parameter.default_value = default_value;
  parameter.minimum = minimum;
  parameter.maximum = maximum;
  parameter.label = std::move(label);
  parameter.tooltip = std::move(tooltip);
  return parameter;
}

FilterParameter choice(std::string name, int default_index, std::vector<std::string> choices,
                       std::string label, std::string tooltip) {
  FilterParameter parameter =
      number(std::move(name), ParameterKind::Choice, default_index, 0,
             static_cast<double>(choices.size()) - 1, std::move(label), std::move(tooltip));
  parameter.choices = std::move(choices);
  return parameter;
}

FilterParameter flag(std::string name, bool default_value, std::string label, std::string tooltip) {
  return number(std::move(name), ParameterKind::Flag, default_value ? 1 : 0, 0, 1, std::move(label),
                std::move(tooltip));
}

/// Shortest text that reads back as the same number.
std::string as_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

/// As `as_text`, but limits are written out: 1000000, not 1e+06.
std::string limit_as_text(double limit) {
  return limit == std::floor(limit) ? std::to_string(static_cast<long long>(limit))
                                    : as_text(limit);
}

double checked_value(const FilterParameter& parameter, double value) {
  const bool whole = parameter.kind == ParameterKind::Real || value == std::floor(value);
  if (value >= parameter.minimum && value <= parameter.maximum && whole) return value;

  std::string sentence =
      "Parameter " + parameter.name + " (" + parameter.label + ") is " + as_text(value) + "; give ";
  if (parameter.kind == ParameterKind::Choice) {
    for (std::size_t k = 0; k < parameter.choices.size(); ++k) {
      if (k > 0) sentence += k + 1 < parameter.choices.size() ? ", " : " or ";
      sentence += std::to_string(k) + " (" + parameter.choices[k] + ")";
    }
  } else {
    sentence += parameter.kind == ParameterKind::Real ? "a number from " : "a whole number from ";
    sentence += limit_as_text(parameter.minimum) + " to " + limit_as_text(parameter.maximum);
  }
  throw Error(ErrorCode::InvalidInput, sentence + ". Nothing was changed.");
}

}  // namespace

std::string filter_name() { return "Remeshing: Weighted Spherical Centroidal Voronoi"; }

std::string filter_help() {
  return "Turns a dense closed scan of a grain into a mesh of <b>exactly the number of nodes asked "
         "for</b>: a series of spherical harmonics is fitted to the surface, nodes on the sphere "
         "are relaxed to a weighted centroidal Voronoi tessellation and put back on the surface. "
         "The result is closed, 2-manifold and free of self-intersections; its errors are in the "
         "log.<br>"
         "<b>It repairs</b> equal points, degenerate faces, orientation and small loose parts, and "
         "says so in the log. <b>It refuses</b>, and changes nothing, when the mesh is open, not "
         "manifold, without volume, not finite or in parts of comparable volume, or folds back "
         "over more directions than the fold limit.<br>"
         "See: <i>Wu F., Huang L., Lai Z.</i> <b>\"A spherical Voronoi tessellation-based approach "
         "for particle surface discretization and reconstruction\"</b>, Engineering Mechanics, "
         "2022, doi 10.6052/j.issn.1000-4750.2022.07.0614";
}

std::vector<FilterParameter> filter_parameters() {
  const RemeshOptions defaults;
  return {
      number("NodeCount", ParameterKind::Integer, defaults.node_count, 4, maximum_node_count,
             "Number of nodes",
             "Vertices of the result, 4 to 1000000. The result has exactly this many, and twice as "
             "many faces less four. The chords lose about 660/N % of the volume."),
      choice("Weighting", static_cast<int>(defaults.weighting),
             {"Constant", "WSCVT-D (radial distance)", "WSCVT-C (curvature)", "Area",
              "Error-adaptive"},
             "Weighting",
             "What decides how large the cell of a node is. Constant: equal solid angles. WSCVT-D: "
             "smaller solid angles far from the centroid, so even triangles. WSCVT-C: more nodes "
             "where the surface bends. Area: equal surface areas. Error-adaptive: nodes where flat "
             "triangles err most."),
      number("HarmonicDegree", ParameterKind::Integer, defaults.degree, 1, 60, "Harmonic degree",
             "Degree of the spherical-harmonic series fitted to the surface, 1 to 60. 20 suits "
             "most grains, 30 rough ones; lower smooths. Lowered, with a line in the log, when the "
             "mesh has too few points to carry it."),
      number(
          "CurvatureAlpha", ParameterKind::Real, defaults.curvature_alpha, -3, 3,
          "Curvature strength alpha",
          "Strength of the curvature weighting (WSCVT-C only), -3 to 3, no unit. 0 ignores "
          "curvature, larger gathers more nodes at edges and corners, negative keeps them away."),
      choice("Placement", static_cast<int>(defaults.placement), {"Fitted surface", "Original mesh"},
             "Place nodes on",
             "Fitted surface: on the harmonic series, which is free of scanning noise. Original "
             "mesh: on the scan itself, with its noise, where rays from the centroid leave it."),
      number("FoldLimit", ParameterKind::Real, 100.0 * defaults.fold_limit, 0, 99, "Fold limit (%)",
             "Largest share of directions, in % of the whole sphere, 0 to 99, in which the surface "
             "may be met more than once from the centroid. Such folds are bridged by their "
             "outermost sheet; above the limit the filter refuses."),
      choice("Metric", static_cast<int>(defaults.relaxation.metric), {"Sphere", "Surface"},
             "Metric",
             "Sphere: cells are centroidal on the unit sphere, the published method. Surface: on "
             "the grain's surface itself, which gives the most even triangles; slower."),
      choice("SeedStart", static_cast<int>(defaults.seed_start),
             {"Multilevel", "Warped lattice", "Random"}, "Start from",
             "Multilevel: a few hundred nodes are relaxed, subdivided and relaxed again; fastest "
             "and most even. Warped lattice: all nodes in a Fibonacci lattice adapted to the "
             "weighting. Random: directions drawn with the random seed; needs many iterations."),
      number("RandomSeed", ParameterKind::Integer, static_cast<double>(defaults.random_seed), 0,
             std::numeric_limits<int>::max(), "Random seed",
             "Start of the random directions, 0 to 2147483647; has no effect unless the "
             "start is random. The same seed gives the same mesh."),
      number("MaxIterations", ParameterKind::Integer, defaults.relaxation.maximum_iterations, 0,
             100000, "Largest number of iterations",
             "Relaxation stops here if it has not converged before, 0 to 100000; the log says "
             "which."),
      flag("NewLayer", true, "Result as a new layer",
           "Checked: the scan is kept and the result becomes a new, current layer. Unchecked: the "
           "result replaces the scan, which cannot be undone."),
      choice("Quality", 0, {"Radial distance", "Curvature", "Cell area"}, "Vertex quality",
             "What the vertex quality of the result holds. Radial distance: from the centroid, in "
             "units of the mesh. Curvature: the largest absolute principal curvature, 1/unit. Cell "
             "area: surface area of the node's cell, unit^2."),
      flag("ColorByQuality", false, "Color by quality",
           "Colors the vertices of the result by their quality, from red (lowest) through green "
           "to blue (highest)."),
  };
}

FilterSettings read_settings(const ParameterValues& values) {
  ParameterValues checked;
  for (const FilterParameter& parameter : filter_parameters()) {
    const auto given = values.find(parameter.name);
    checked[parameter.name] =
        given == values.end() ? parameter.default_value : checked_value(parameter, given->second);
  }
  const auto whole = [&](const char* name) { return static_cast<int>(checked.at(name)); };

  FilterSettings settings;
  RemeshOptions& options = settings.options;
  options.node_count = whole("NodeCount");
  options.weighting = static_cast<Weighting>(whole("Weighting"));
  options.degree = whole("HarmonicDegree");
  options.curvature_alpha = checked.at("CurvatureAlpha");
  options.placement = static_cast<NodePlacement>(whole("Placement"));
  options.fold_limit = checked.at("FoldLimit") / 100.0;
  options.relaxation.metric = static_cast<RelaxationMetric>(whole("Metric"));
  options.seed_start = static_cast<SeedStart>(whole("SeedStart"));
  options.random_seed = static_cast<std::uint64_t>(whole("RandomSeed"));
  options.relaxation.maximum_iterations = whole("MaxIterations");
  settings.new_layer = whole("NewLayer") != 0;
  settings.quality = static_cast<VertexQuality>(whole("Quality"));
  options.node_curvatures = settings.quality == VertexQuality::Curvature;
  settings.colour_by_quality = whole("ColorByQuality") != 0;
  return settings;
}

double typed_value(float value) {
  std::array<char, 32> buffer{};
  const auto text = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  double result = 0.0;
  std::from_chars(buffer.data(), text.ptr, result);
  return result;
}

std::string weighting_name(Weighting weighting) {
  switch (weighting) {
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

const std::vector<double>& quality_values(const RemeshResult& result, VertexQuality quality) {
  switch (quality) {
    case VertexQuality::Curvature:
      return result.curvatures;
    case VertexQuality::CellArea:
      return result.cell_areas;
    case VertexQuality::RadialDistance:
      break;
  }
  return result.radial_distances;
}

}  // namespace wscvt::filter
