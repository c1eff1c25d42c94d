// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "layers.h"
#include "log_text.h"
#include "parameters.h"
#include "wscvt/base/execution.h"

namespace wscvt::filter {

// The interface of the filters for every host. A host's adapter shows this list and passes values,
// layers and a callback to run_filter.

/// In the order of the host's action numbers.
enum class FilterId { Remesh, Create, Describe };

/// Properties of a filter for a host.
struct Filter {
  FilterId id = FilterId::Remesh;
  std::string name;         ///< the menu text; saved scripts refer to it: it never changes
  std::string python_name;  ///< in PyMeshLab: never changes
  std::string help;         ///< HTML
  ParameterList parameters;
};

/// All filters.
std::vector<Filter> all_filters();

/// Returns the filter with this number, or the remesher if there is no such filter.
Filter filter_with_number(int number);

/// Result of a run.
struct FilterOutcome {
  std::vector<LogLine> log;
  std::map<std::string, double> values;  ///< results by name, for scripts
};

/// Runs a filter on the current layer. Missing values get their defaults, and the log has a
/// warning. If it throws Error, the document is unchanged.
FilterOutcome run_filter(FilterId filter, const ParameterValues& values, Layers& layers,
                         const ProgressCallback& progress);

/// Returns a sentence for the user about the current exception. Every host catches all exceptions,
/// because an exception that leaves a filter ends the host.
std::string sentence_of_current_exception();

}  // namespace wscvt::filter
