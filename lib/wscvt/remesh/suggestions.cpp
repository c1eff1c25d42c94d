// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/suggestions.h"

#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh/remesh_warnings.h"

namespace wscvt {

namespace {

/// A setting to be tried.
struct Trial {
  std::string name;
  RemeshOptions options;
};

/// A large edge ratio, at which the triangles of error-adaptive nodes are close and still even.
constexpr double closer_edge_ratio = 1.4;

/// What is tried, in this order, until one is accurate.
std::vector<Trial> trials_for(const RemeshOptions& options) {
  RemeshOptions plain = options;
  plain.target.percent = 0.0;
  plain.measures = MeasureOptions();
  std::vector<Trial> trials;
  if (const auto* on_scan = std::get_if<OnScanOptions>(&options.method)) {
    OnScanOptions changed = *on_scan;
    const auto add = [&](const std::string& name) {
      plain.method = changed;
      trials.push_back({name, plain});
    };
    if (on_scan->placement == ScanPlacement::OnSurface) {
      changed.placement = ScanPlacement::Fitted;
      add("fitted nodes");
    }
    if (on_scan->weighting != CellWeighting::ErrorAdaptive) {
      changed.weighting = CellWeighting::ErrorAdaptive;
      add("error-adaptive weighting");
    }
    if (on_scan->edge_ratio < closer_edge_ratio) {
      changed.edge_ratio = closer_edge_ratio;
      add("error-adaptive weighting and a mean edge ratio of " + format_number(closer_edge_ratio));
    }
    plain.method = *on_scan;
  } else {
    plain.method = OnScanOptions();
    trials.push_back({"the method on-scan", plain});
    plain.method = options.method;
  }
  // More would take long only to be told so.
  constexpr int most_nodes_tried = 20000;
  if (2 * options.node_count <= most_nodes_tried) {
    plain.node_count = 2 * options.node_count;
    trials.push_back({std::to_string(plain.node_count) + " nodes", plain});
  }
  return trials;
}

}  // namespace

std::vector<SuggestedSetting> suggest_settings(const RemeshOptions& options,
                                               const RemeshWith& remesh_with,
                                               const Execution& execution) {
  std::vector<SuggestedSetting> suggestions;
  const std::vector<Trial> trials = trials_for(options);
  const auto count = static_cast<double>(trials.size());
  for (std::size_t k = 0; k < trials.size(); ++k) {
    try {
      const RemeshResult result = remesh_with(
          trials[k].options,
          execution.part(static_cast<double>(k) / count, static_cast<double>(k + 1) / count));
      suggestions.push_back({trials[k].name, result.rms_distance / result.input.equivalent_radius,
                             result.remesh.area / result.original.area - 1.0});
      if (!is_inaccurate(result)) break;
    } catch (const Error& error) {
      // A setting that does not work is no suggestion.
      if (error.code() == ErrorCode::Cancelled) throw;
    }
  }
  return suggestions;
}

}  // namespace wscvt
