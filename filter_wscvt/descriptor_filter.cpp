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
      option_parameter("RoundnessDegree", defaults.roundness_degree, roundness_degree_option,
                       "Degree of roundness",
                       "Degree of the harmonic series whose corners roundness reads. "
                       "Higher sees sharper corners, and noise."),
      option_parameter("RoughnessDegree", defaults.roughness_degree, roughness_degree_option,
                       "Roughness starts above degree",
                       "Degree of the smooth shape that roughness is measured from. "
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
  check_descriptor_report_file(settings.report_file, !settings.reference_layer.empty());
  return settings;
}

std::vector<LogLine> log_lines(const GrainMeasures& measures, double seconds) {
  std::vector<std::string> lines = descriptor_lines(measures);
  lines.push_back(seconds_line(seconds));
  return as_log(remarks(measures), lines);
}

}  // namespace wscvt::filter
