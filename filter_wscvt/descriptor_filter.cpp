// SPDX-License-Identifier: GPL-3.0-or-later
#include "descriptor_filter.h"

#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "html_report.h"
#include "log_text.h"
#include "report_file.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"

namespace wscvt::filter {

namespace {

using Json = nlohmann::ordered_json;

struct DistanceRow {
  std::string key;
  std::string label;
  double value;  ///< length
};

std::vector<DistanceRow> distance_rows(const DescriptorResult& result) {
  if (!result.distances) return {};
  const OneSidedDistance& to = result.distances->to_reference;
  const OneSidedDistance& from = result.distances->from_reference;
  return {
      {"hausdorff_distance", "largest (Hausdorff), two-sided", result.distances->hausdorff},
      {"hausdorff_to_reference", "largest, to the reference", to.maximum},
      {"hausdorff_from_reference", "largest, from the reference", from.maximum},
      {"rms_distance", "root mean square, two-sided", result.distances->root_mean_square},
      {"rms_to_reference", "root mean square, to the reference", to.root_mean_square},
      {"rms_from_reference", "root mean square, from the reference", from.root_mean_square},
      {"mean_to_reference", "mean, to the reference", to.mean},
      {"mean_from_reference", "mean, from the reference", from.mean},
  };
}

std::vector<std::string> distance_lines(const DescriptorResult& result) {
  if (!result.distances) return {};
  const double radius = result.reference->checked.report.equivalent_radius;
  std::vector<std::vector<std::string>> cells = {{"Distance", "length", "% of equivalent radius"}};
  for (const DistanceRow& row : distance_rows(result)) {
    cells.push_back({"  " + row.label, format_number(row.value, 4),
                     format_number(100.0 * row.value / radius, 4)});
  }
  return aligned_lines(cells);
}

std::vector<DescriptorComparison> comparison(const DescriptorResult& result) {
  return compare_descriptors(list_descriptors(result.reference->descriptors),
                             list_descriptors(result.mesh.descriptors));
}

const ComparisonNames file_names = {"reference", "value"};

std::string layer_line(const MeasuredMesh& mesh) {
  return mesh.name + ": " + std::to_string(mesh.checked.report.vertices) + " vertices, " +
         std::to_string(mesh.checked.report.faces) + " faces, genus " +
         std::to_string(mesh.checked.report.genus);
}

/// What a reader should know about a mesh before reading its numbers.
std::vector<std::string> remarks(const MeasuredMesh& mesh) {
  std::vector<std::string> sentences;
  if (mesh.checked.report.components > 1) {
    sentences.push_back("Only the largest of the " +
                        std::to_string(mesh.checked.report.components) + " parts of '" + mesh.name +
                        "' was measured.");
  }
  const MeshCheckReport& report = mesh.checked.report;
  const double mended = report.flap_area_share + report.filled_area_share;
  if (mended > 0.0) {
    sentences.push_back("Holes and non-manifold edges of '" + mesh.name +
                        "' were mended for the measurement, which changed " +
                        format_number(100.0 * mended, 3) + " % of its area.");
  }
  if (!mesh.descriptors.has_radius) {
    sentences.push_back("The volume centroid of '" + mesh.name +
                        "' lies outside it, so it has no roundness and no roughness.");
  } else if (mesh.descriptors.folded_share > 0.01) {
    sentences.push_back("Seen from its centroid '" + mesh.name + "' folds over itself on " +
                        format_number(100.0 * mesh.descriptors.folded_share, 3) +
                        " % of the directions; roundness and roughness are those of its outermost "
                        "layer.");
  }
  return sentences;
}

std::vector<std::string> all_remarks(const DescriptorResult& result) {
  std::vector<std::string> sentences = remarks(result.mesh);
  if (result.reference) {
    std::vector<std::string> more = remarks(*result.reference);
    sentences.insert(sentences.end(), std::make_move_iterator(more.begin()),
                     std::make_move_iterator(more.end()));
  }
  return sentences;
}

std::string json_report(const DescriptorResult& result) {
  Json report = {{"format", "wscvt-descriptors"}, {"version", 1}, {"layer", result.mesh.name}};
  if (result.reference) {
    report["reference"] = result.reference->name;
    report["descriptors"] = Json::parse(table_json(comparison(result), file_names));
    Json& distances = report["distances"] = Json::object();
    for (const DistanceRow& row : distance_rows(result)) distances[row.key] = row.value;
  } else {
    report["descriptors"] = Json::parse(table_json(list_descriptors(result.mesh.descriptors)));
  }
  report["remarks"] = all_remarks(result);
  // A layer's name may not be UTF-8.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_report(const DescriptorResult& result) {
  std::vector<std::string> header = {"layer", "reference"};
  std::vector<std::string> fields = {result.mesh.name,
                                     result.reference ? result.reference->name : ""};
  const auto add = [&](const std::string& key, double value) {
    header.push_back(key);
    fields.push_back(format_exact(value));
  };
  if (result.reference) {
    for (const DescriptorComparison& row : comparison(result)) {
      add(row.key + "_reference", row.reference);
      add(row.key + "_value", row.value);
      add(row.key + "_error_percent", row.error_percent);
    }
    for (const DistanceRow& row : distance_rows(result)) add(row.key, row.value);
  } else {
    for (const DescriptorValue& row : list_descriptors(result.mesh.descriptors)) {
      add(row.key, row.value);
    }
  }
  return csv_record(header) + csv_record(fields);
}

std::string html_report(const DescriptorResult& result) {
  HtmlReport report("Shape of " + result.mesh.name);
  report.add_paragraph(layer_line(result.mesh));
  if (result.reference) report.add_paragraph("Compared with " + layer_line(*result.reference));
  for (const std::string& remark : all_remarks(result)) report.add_paragraph(remark);
  if (result.reference) {
    const ComparisonNames names = {result.reference->name, result.mesh.name};
    report.add_table(comparison(result), names);
    report.add_lines("Distances", distance_lines(result));
    report.add_histograms(result.reference->checked.mesh, result.mesh.checked.mesh, names);
  } else {
    report.add_table(list_descriptors(result.mesh.descriptors));
    report.add_histograms({}, result.mesh.checked.mesh, {"", result.mesh.name});
  }
  return report.text();
}

MeasuredMesh measured(NamedMesh mesh, const DetailedOptions& options, const Execution& execution) {
  try {
    CheckedMesh checked = check_mesh(std::move(mesh.mesh), MeshCheckOptions(), execution);
    const DetailedDescriptors descriptors =
        describe_shape_in_detail(checked.mesh, options, execution);
    return {std::move(mesh.name), std::move(checked), descriptors};
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    throw Error(error.code(), "Layer '" + mesh.name + "': " + error.what());
  }
}

}  // namespace

std::string descriptor_name() { return "Grain shape descriptors"; }

std::string descriptor_help() {
  return "Measures the shape of the current layer, a closed mesh of a grain: size, axes, "
         "sphericity, convexity, roundness, roughness and orientation; against a second layer also "
         "errors and distances. Layers are measured as they are shown and not changed. It mends "
         "small "
         "faults for that, and says so; it refuses what needs more, or is in parts. See: "
         "<i>Wadell</i>, 1932; <i>Krumbein</i>, 1941; "
         "<i>Kong, Fonseca</i>, 2018";
}

ParameterList descriptor_parameters() {
  const DetailedOptions defaults;
  return {
      text_parameter("ReferenceLayer", "Compare with layer",
                     "A second layer as the list of layers shows it, its name with or without the "
                     "ending or its number, or nothing: errors are those of the current layer "
                     "against this one, the original."),
      integer_parameter("RoundnessDegree", defaults.roundness_degree, 1, 60, "Degree of roundness",
                        "Degree of the harmonic series whose corners roundness reads, 1 to 60. "
                        "Higher sees sharper corners, and noise."),
      integer_parameter("RoughnessDegree", defaults.roughness_degree, 0, 60,
                        "Roughness starts above degree",
                        "Degree of the smooth shape that roughness is measured from, 0 to 60. "
                        "What the series up to it describes counts as form, the rest as "
                        "roughness."),
      report_file_parameter(),
  };
}

DescriptorSettings read_descriptor_settings(const ParameterValues& values) {
  const CheckedValues checked(descriptor_parameters(), values);
  DescriptorSettings settings;
  settings.reference_layer = checked.text("ReferenceLayer");
  settings.options.roundness_degree = checked.whole("RoundnessDegree");
  settings.options.roughness_degree = checked.whole("RoughnessDegree");
  settings.report_file = checked.text("ReportFile");
  check_report_file(settings.report_file);
  return settings;
}

DescriptorResult measure_grains(NamedMesh mesh, std::optional<NamedMesh> reference,
                                const DetailedOptions& options, const Execution& execution) {
  const double share = reference ? 0.4 : 1.0;
  DescriptorResult result;
  execution.report(0.0, "Measuring the layer");
  result.mesh = measured(std::move(mesh), options, execution.part(0.0, share));
  if (reference) {
    execution.report(0.4, "Measuring the second layer");
    result.reference = measured(std::move(*reference), options, execution.part(0.4, 0.8));
    execution.report(0.8, "Measuring distances");
    result.distances = measure_distances(result.mesh.checked.mesh, result.reference->checked.mesh,
                                         DistanceOptions(), execution.part(0.8, 1.0));
  }
  return result;
}

std::vector<LogLine> descriptor_lines(const DescriptorResult& result, double seconds) {
  std::vector<std::string> lines = {"Layer       " + layer_line(result.mesh)};
  const auto append = [&](std::vector<std::string> more) {
    for (std::string& line : more) lines.push_back(std::move(line));
  };
  if (result.reference) {
    lines.push_back("Reference   " + layer_line(*result.reference));
    append(table_lines(comparison(result), {result.reference->name, result.mesh.name}));
    append(distance_lines(result));
  } else {
    append(table_lines(list_descriptors(result.mesh.descriptors)));
  }
  lines.push_back(seconds_line(seconds));
  return as_log(all_remarks(result), lines);
}

void write_report(const DescriptorResult& result, const std::string& path) {
  switch (report_format(path)) {
    case ReportFormat::None:
      return;
    case ReportFormat::Html:
      return write_file(path, html_report(result));
    case ReportFormat::Json:
      return write_file(path, json_report(result));
    case ReportFormat::Csv:
      return write_file(path, csv_report(result));
  }
}

}  // namespace wscvt::filter
