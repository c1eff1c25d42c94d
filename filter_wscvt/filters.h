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

// The filters as every host sees them. A host's adapter shows what is listed here and hands over
// values, layers and a callback; everything else happens behind run_filter.

/// In the order of the host's action numbers.
enum class FilterId { Everyday, Remesh, Create, Describe };

/// Under which heading a host lists a filter.
enum class FilterMenu { Remeshing, Creation, Measure };

/// What a host asks about a filter.
struct Filter {
  FilterId id = FilterId::Remesh;
  std::string name;         ///< the menu text; saved scripts refer to it: it never changes
  std::string python_name;  ///< in PyMeshLab; never changes either
  std::string help;         ///< HTML
  ParameterList parameters;
  FilterMenu menu = FilterMenu::Remeshing;
  bool needs_faces = false;  ///< of the current layer
  bool makes_layers = true;
};

/// All filters.
std::vector<Filter> all_filters();

/// The filter with a number; the remesher for a number that none has.
Filter filter_with_number(int number);

/// What a run hands back.
struct FilterOutcome {
  std::vector<LogLine> log;
  std::map<std::string, double> values;  ///< results by name, for scripts
};

/// Runs a filter on the current layer. Values that are missing take their defaults, and the log
/// warns of it. Throws Error; the document is then as it was.
FilterOutcome run_filter(FilterId filter, const ParameterValues& values, Layers& layers,
                         const ProgressCallback& progress);

/// The sentence for a user about the exception that is being handled: every host catches
/// everything, because an exception that leaves a filter ends the host.
std::string sentence_of_current_exception();

}  // namespace wscvt::filter
