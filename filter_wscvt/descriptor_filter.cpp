// SPDX-License-Identifier: GPL-3.0-or-later
#include "descriptor_filter.h"

#include "log_text.h"
#include "report_file.h"
#include "wscvt/report/report.h"

namespace wscvt::filter {

std::string descriptor_name() { return "Grain shape descriptors"; }

std::string descriptor_help() {
  return "Measures the shape of the current layer, a closed mesh of a grain: size, axes, "
         "sphericity, convexity, roundness, roughness and orientation; against a second layer also "
         "errors and distances. Layers are measured as shown and not changed. It mends small "
         "faults "
         "for that, and says so; it refuses what needs more. See: "
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
      option_parameter("RoundnessBall", defaults.roundness_ball, roundness_ball_option,
                       "Ball of roundness",
                       "Radius of the balls that roundness reads curvature in, over the radius of "
                       "the largest inscribed sphere. A smaller ball sees sharper corners, and "
                       "noise. For scans of voxels take six voxels or more."),
      option_parameter("RoughnessCutoff", defaults.roughness_cutoff, roughness_cutoff_option,
                       "Cut-off length of roughness",
                       "Longest wave that counts as roughness, over the radius of the sphere of "
                       "equal volume. Longer waves are form. Roughness grows with it, so compare "
                       "grains at the same cut-off only."),
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

std::vector<LogLine> log_lines(const GrainMeasures& measures, double seconds) {
  std::vector<std::string> lines = descriptor_lines(measures);
  lines.push_back(seconds_line(seconds));
  return as_log(remarks(measures), lines);
}

}  // namespace wscvt::filter
