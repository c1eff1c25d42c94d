// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "log_text.h"
#include "node_parameters.h"
#include "parameters.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

/// The remesher's menu text. Saved scripts refer to it: it never changes.
std::string remesh_name();

/// Returns the filter's description, limits and references as HTML.
std::string remesh_help();

/// The most important first; the others are advanced.
ParameterList remesh_parameters();

/// All settings of the user.
struct RemeshSettings {
  RemeshOptions options;
  bool new_layer = true;
  bool keep_attributes = true;  ///< colour and quality of the scan
  ResultSettings result;
  std::string coefficients_file;  ///< output; empty: none
};

/// Throws Error(InvalidInput) for values that do not fit and file names with other extensions.
RemeshSettings read_remesh_settings(const ParameterValues& values);

/// Returns a run's log, short and narrow enough for a host's panel: changes with one row per
/// measure, repairs, time, the `notes`, warnings, verdict. The report contains everything else.
std::vector<LogLine> log_lines(const RemeshResult& result, double seconds,
                               const std::vector<std::string>& notes = {});

}  // namespace wscvt::filter
