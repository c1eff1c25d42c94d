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

/// As log_lines of the remesher. `more` are warnings before those of the measures.
std::vector<LogLine> log_lines(const GrainMeasures& measures, double seconds,
                               const std::vector<Sentence>& more = {});

}  // namespace wscvt::filter
