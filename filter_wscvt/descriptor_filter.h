// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "log_text.h"
#include "parameters.h"
#include "wscvt/measures/grain_measures.h"

namespace wscvt::filter {

/// The menu text. Saved scripts refer to it: it never changes.
std::string descriptor_name();

std::string descriptor_help();

ParameterList descriptor_parameters();

struct DescriptorSettings {
  std::string reference_layer;  ///< label; empty: none
  DetailedOptions options;
  std::string report_file;  ///< empty: none
};

/// Throws Error(InvalidInput) for values that do not fit and file names with other extensions.
DescriptorSettings read_descriptor_settings(const ParameterValues& values);

/// As log_lines of the remesher.
std::vector<LogLine> log_lines(const GrainMeasures& measures, double seconds);

/// Writes the report in the format of the file's extension; nothing for an empty name. Throws
/// Error(InputOutput) when the file cannot be written, Error(InvalidInput) for an extension other
/// than .html, .json or .csv, and for an HTML report when there is no QApplication to draw with.
void write_report(const GrainMeasures& measures, const std::string& path);

}  // namespace wscvt::filter
