// SPDX-License-Identifier: GPL-3.0-or-later
#include "descriptor_filter.h"

#include <utility>

#include "report_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/report.h"

namespace wscvt::filter {

namespace {

// Numbers have five digits and the names of layers are above the table, to keep it narrow.

std::vector<std::vector<std::string>> descriptor_rows(const GrainMeasures& measures) {
  std::vector<std::vector<std::string>> rows = {{"Descriptor", "value"}};
  for (const DescriptorValue& row : list_descriptors(measures.grain.descriptors)) {
    rows.push_back({"  " + row.label, format_number(row.value, 5)});
  }
  return rows;
}

std::vector<std::vector<std::string>> comparison_rows(const GrainMeasures& measures) {
  std::vector<std::vector<std::string>> rows = {{"Descriptor", "reference", "layer", "error %"}};
  for (const DescriptorComparison& row : compare_descriptors(measures)) {
    rows.push_back({"  " + row.label, format_number(row.reference, 5), format_number(row.value, 5),
                    format_error(row.error_percent)});
  }
  return rows;
}

std::vector<std::vector<std::string>> distance_rows(const GrainMeasures& measures) {
  const double radius = measures.reference->checked.report.equivalent_radius;
  std::vector<std::vector<std::string>> rows = {{"Distance", "length", "% of radius"}};
  for (const DistanceRow& row : list_distances(measures)) {
    rows.push_back({"  " + row.label, format_number(row.value, 4),
                    format_number(100.0 * row.value / radius, 4)});
  }
  return rows;
}

}  // namespace

std::string descriptor_name() { return "Grain shape descriptors"; }

std::string descriptor_help() {
  return "Measures the shape of the current layer, a closed mesh of a grain: size, axes, "
         "sphericity, convexity, roundness, roughness and orientation. With a second layer also "
         "errors and distances. Layers are measured as shown and not changed. Small faults are "
         "repaired first, larger faults are an error. See: "
         "<i>Wadell</i>, 1932; <i>Krumbein</i>, 1941; "
         "<i>Kong, Fonseca</i>, 2018";
}

ParameterList descriptor_parameters() {
  const DetailedOptions defaults;
  return {
      text_parameter("ReferenceLayer", "Compare with layer",
                     "Name or number of the layer to compare with, as in the list of layers. "
                     "Errors and distances of the current layer are measured against it. Empty: no "
                     "comparison."),
      option_parameter("RoundnessBall", defaults.roundness_ball, roundness_ball_option,
                       "Ball radius for roundness",
                       "Radius of the balls in which curvature is measured for roundness, divided "
                       "by the radius of the largest inscribed sphere. Smaller balls detect "
                       "sharper corners, and noise. For scans of voxels use six voxels or more."),
      option_parameter("RoughnessCutoff", defaults.roughness_cutoff, roughness_cutoff_option,
                       "Cut-off length of roughness",
                       "Longest wave that counts as roughness, divided by the radius of the sphere "
                       "of equal volume. Longer waves are form. Roughness grows with the cut-off: "
                       "compare grains only at the same cut-off."),
      report_file_parameter(),
  };
}

DescriptorSettings read_descriptor_settings(const ParameterValues& values) {
  const CheckedValues checked(descriptor_parameters(), values);
  DescriptorSettings settings;
  settings.reference_layer = checked.text("ReferenceLayer");
  settings.options.roundness_ball = checked.real("RoundnessBall");
  settings.options.roughness_cutoff = checked.real("RoughnessCutoff");
  settings.report_file = checked.text("ReportFile");
  check_descriptor_report_file(settings.report_file, !settings.reference_layer.empty());
  return settings;
}

std::vector<LogLine> log_lines(const GrainMeasures& measures, double seconds,
                               const std::vector<Sentence>& more) {
  std::vector<std::string> lines = {"Layer       " + grain_line(measures.grain)};
  const auto append = [&](const std::vector<std::vector<std::string>>& table) {
    for (std::string& line : log_table(table)) lines.push_back(std::move(line));
  };
  std::vector<NamedMass> masses;
  if (measures.reference) {
    lines.push_back("Reference   " + grain_line(*measures.reference));
    append(comparison_rows(measures));
    append(distance_rows(measures));
    masses.push_back({"reference layer", mass_properties(measures.reference->descriptors.basic)});
  } else {
    append(descriptor_rows(measures));
  }
  masses.push_back({"this layer", mass_properties(measures.grain.descriptors.basic)});
  append(mass_rows(masses));
  lines.push_back(seconds_line(seconds));
  std::vector<std::string> warnings;
  for (const Sentence& warning : more) warnings.push_back(shown_words(warning));
  for (const Sentence& remark : remarks(measures)) warnings.push_back(shown_words(remark));
  if (warnings.empty()) return as_log({}, lines, {});
  return as_log(warnings, lines,
                {"Look at: " + named_warnings({warnings.begin(), warnings.end()}), true});
}

}  // namespace wscvt::filter
