// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_filter.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "log_text.h"
#include "node_parameters.h"
#include "report_file.h"
#include "wscvt/base/error.h"
#include "wscvt/base/option.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt::filter {

std::string remesh_name() { return "Remeshing: Weighted Spherical Centroidal Voronoi"; }

std::string remesh_help() {
  // Three lines: the dialog of 2020.09 does not scroll, and a longer text would push Apply off the
  // screen. MeshLab's search uses the words of the filter's name and of this text.
  return "Isotropic CVT of <b>exactly N nodes</b>: simplify, decimate or resample a sand grain "
         "(particle) for DEM. WSCVT: <i>Wu F., Huang L., Lai Z.</i>, doi "
         "10.6052/j.issn.1000-4750.2022.07.0614";
}

namespace {

/// The parameters that a grain seldom needs.
ParameterList seldom_needed_parameters() {
  const RemeshOptions defaults;
  const AsPublishedOptions published;
  ParameterList parameters = {
      option_parameter("ErrorTarget", defaults.target.percent, error_target_option,
                       "Allowed error (%)",
                       "Above 0: searches for few nodes with at most this error, from the number "
                       "given up to " +
                           typed_text(defaults.target.largest_node_count) +
                           ". The log lists the errors. Takes ten times as long."),
      table_parameter("TargetMeasure", defaults.target.measure, "Error measure",
                      "The error to be limited, in % of the scan's value."),
      curvature_alpha_parameter(),
      placement_parameter(),
      option_parameter("HarmonicDegree", defaults.degree, harmonic_degree_option,
                       "Degree of the SH series",
                       "As published: degree of the spherical-harmonic surface. On the scan: "
                       "degree of the saved coefficients only."),
      option_parameter(
          "FoldLimit", published.max_overhang_percent, max_overhang_option,
          "Max. overhang (% of solid angle)",
          "As published only. The filter stops if overhangs cover more of the sphere than this. An "
          "overhang is surface that a ray from the centroid hits after its first hit."),
      option_parameter(
          "MendLimit", defaults.max_repaired_area_percent, repaired_area_limit_option,
          "Max. repaired area (%)",
          "The filter fills holes. At non-manifold edges it removes flaps and internal walls. It "
          "stops if this changes more of the area than this limit."),
      flag_parameter(
          "Points", defaults.points, "Rebuild the surface from the points",
          "Checked: ignores the faces and builds a star-shaped surface through the points. "
          "Overhangs are lost. Unchecked: a layer without faces is an error."),
      flag_parameter(
          "NewLayer", true, "Result as a new layer",
          "Unchecked: the result replaces the scan, which cannot be undone. Checked: it becomes a "
          "new, current layer."),
      flag_parameter("KeepColors", true, "Keep colors and labels",
                     "The result takes color and quality from the nearest point of the scan. "
                     "The scan's quality then replaces the radial distance."),
      file_parameter("CoefficientsFile", ParameterKind::OutputFile, {".json", ".sh"},
                     "Coefficients file",
                     "For the coefficients of the SH series: .json, or .sh for SHTOOLS (no "
                     "overhangs). Empty: no file. The filter that creates grains reads it."),
  };
  for (FilterParameter& parameter : parameters) parameter.advanced = true;
  return parameters;
}

}  // namespace

ParameterList remesh_parameters() {
  ParameterList parameters = {
      node_count_parameter(),
      method_parameter(),
      weighting_parameter(),
      edge_ratio_parameter(),
      flag_parameter("Distances", RemeshOptions().measures.distances, "Measure distances",
                     "Largest, rms and mean distance between scan and remesh, both ways, for log "
                     "and report. Takes about a second."),
      table_parameter("Quality", RemeshSettings().result.quality, "Vertex quality",
                      "Value stored as the quality of each vertex of the result."),
      colour_by_quality_parameter(),
      report_file_parameter(),
  };
  for (FilterParameter& parameter : seldom_needed_parameters()) {
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

namespace {

/// Coefficients of grains with overhangs need a map to the sphere, which the plugin has not.
SeriesCoefficients series_of_radius(const IndexedMesh& scan, int degree,
                                    const Execution& execution) {
  SeriesCoefficients series = radial_coefficients(scan, degree, execution);
  if (series.radius.empty()) {
    throw Error(ErrorCode::NotStarShaped,
                "Rays from the centroid do not see all of the scan, so its SH series is not one of "
                "the radius. Leave the parameter CoefficientsFile empty, or write the coefficients "
                "of x, y and z by the program: wscvt remesh --coefficients.");
  }
  return series;
}

}  // namespace

RemeshSettings read_remesh_settings(const ParameterValues& values) {
  const CheckedValues checked(remesh_parameters(), values);
  RemeshSettings settings;
  RemeshOptions& options = settings.options;
  options = read_node_options(checked, false);
  options.target.percent = checked.real("ErrorTarget");
  options.target.measure = checked.choice<ErrorMeasure>("TargetMeasure");
  options.target.largest_node_count =
      std::max(options.target.largest_node_count, options.node_count);
  options.degree = checked.whole("HarmonicDegree");
  const double max_overhang = checked.real("FoldLimit");
  if (auto* published = std::get_if<AsPublishedOptions>(&options.method)) {
    published->max_overhang_percent = max_overhang;
  } else if (max_overhang != AsPublishedOptions().max_overhang_percent) {
    refuse("Parameter FoldLimit is " + typed_text(max_overhang) +
           ". Only the method \"As published\" has this limit. Leave it at its default. Nothing "
           "was changed.");
  }
  options.max_repaired_area_percent = checked.real("MendLimit");
  options.points = checked.flag("Points");
  options.measures.distances = checked.flag("Distances");
  settings.new_layer = checked.flag("NewLayer");
  settings.result.quality = checked.choice<VertexQuality>("Quality");
  request_quality(options, settings.result.quality);
  settings.result.colour_by_quality = checked.flag("ColorByQuality");
  settings.result.report_file = checked.text("ReportFile");
  check_remesh_report_file(settings.result.report_file);
  settings.keep_attributes = checked.flag("KeepColors");
  settings.coefficients_file = checked.text("CoefficientsFile");
  if (!settings.coefficients_file.empty()) options.measures.series = series_of_radius;
  check_output_file(settings.coefficients_file, {".json", ".sh"}, "CoefficientsFile");
  check_different_files(settings.result.report_file, "ReportFile", settings.coefficients_file,
                        "CoefficientsFile");
  return settings;
}

namespace {

/// The descriptors of the short table, by key.
const std::map<std::string, std::string> short_labels = {{"volume", "volume"},
                                                         {"area", "surface area"},
                                                         {"sphericity_wadell", "sphericity"},
                                                         {"aspect_ratio_inertia", "aspect ratio"},
                                                         {"sdq_invariant", "Sdq"}};

/// Appends the lines of the library's report on these topics.
void append_topics(std::vector<std::string>& lines, const std::vector<std::string>& report,
                   const std::vector<std::string>& topics) {
  for (const std::string& line : report) {
    for (const std::string& topic : topics) {
      const bool is_news = line.find("none needed") == std::string::npos;
      if (line.rfind(topic + " ", 0) == 0 && is_news) lines.push_back(line);
    }
  }
}

/// The most important measures, one row each: scan, remesh, error in %.
std::vector<std::string> short_table(const RemeshResult& result) {
  std::vector<std::vector<std::string>> cells = {{"", "scan", "remesh", "error %"}};
  const auto add = [&](const std::string& label, double from, double to) {
    cells.push_back({"  " + label, format_number(from, 5), format_number(to, 5), ""});
  };
  // A surface from a formula has neither vertices nor triangles.
  const bool is_scan = result.input.input_vertices > 0;
  const double none = std::numeric_limits<double>::quiet_NaN();
  // Counts are never abbreviated.
  const auto add_count = [&](const std::string& label, std::size_t from, std::size_t to) {
    cells.push_back({"  " + label, is_scan ? std::to_string(from) : "-", std::to_string(to), ""});
  };
  add_count("vertices", result.input.vertices, result.mesh.points.size());
  add_count("faces", result.input.faces, result.mesh.triangles.size());
  for (const DescriptorComparison& row :
       compare_descriptors(list_descriptors(result.scan), list_descriptors(result.remesh))) {
    const auto label = short_labels.find(row.key);
    if (label == short_labels.end()) continue;
    cells.push_back({"  " + label->second, format_number(row.reference, 5),
                     format_number(row.value, 5), format_error(row.error_percent)});
  }
  add("mean edge ratio", is_scan ? result.scan_quality.edge_ratio.mean : none,
      result.quality.edge_ratio.mean);
  add("smallest angle, degrees", is_scan ? result.scan_quality.smallest_angle : none,
      result.quality.smallest_angle);
  if (result.distances) {
    const double radius = result.input.equivalent_radius;
    const auto add_distance = [&](const std::string& label, double length) {
      cells.push_back({"  " + label + " distance, % of radius", "",
                       format_number(100.0 * length / radius, 3), ""});
    };
    add_distance("largest", result.distances->largest);
    add_distance("rms", result.distances->root_mean_square);
    add_distance("mean", std::max(result.distances->to_reference.mean,
                                  result.distances->from_reference.mean));
  }
  return log_table(cells);
}

/// Returns where the nodes are, by their signed distances from the scan.
std::string nodes_line(const std::vector<double>& distances) {
  const auto [lowest, highest] = std::minmax_element(distances.begin(), distances.end());
  const auto place = [](double distance) {
    if (distance == 0.0) return std::string("on the scan");
    return format_number(distance, 3) + (distance < 0.0 ? " (inside)" : " (outside)");
  };
  if (*lowest == *highest) return "All nodes are " + place(*lowest);
  return "Nodes are from " + place(*lowest) + " to " + place(*highest);
}

}  // namespace

std::vector<LogLine> log_lines(const RemeshResult& result, double seconds,
                               const std::vector<std::string>& notes) {
  std::vector<std::string> lines = short_table(result);
  const std::vector<std::string> report = report_lines(result);
  if (result.input.input_vertices > 0) append_topics(lines, report, {"Repairs", "Handles"});
  append_topics(lines, report, {"Node count"});
  if (!result.vertex_distances.empty()) {
    lines.push_back(nodes_line(quality_values(result, VertexQuality::OriginalDistance)));
  }
  lines.push_back(seconds_line(seconds));
  lines.insert(lines.end(), notes.begin(), notes.end());
  std::vector<std::string> warnings;
  // The table above has a row of Sdq.
  for (const Sentence& warning : report_warnings(result)) warnings.push_back(shown_words(warning));
  return as_log(warnings, lines, {verdict_line(result), !result.warnings.empty()});
}

}  // namespace wscvt::filter
