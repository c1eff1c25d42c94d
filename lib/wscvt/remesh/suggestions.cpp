// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/suggestions.h"

#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

/// A setting to be tried.
struct Trial {
  std::string name;
  RemeshOptions options;
};

/// A large edge ratio, at which the triangles of error-adaptive nodes are close and still even.
constexpr double closer_edge_ratio = 1.4;

/// The setting that helps most of those that may be tried. Trials may cost as much as the run, so
/// there is one, with as many nodes: it makes the scan ready for other options and places its
/// nodes, as the run did. Twice the nodes, or a second setting, would cost more, whatever came of
/// it.
std::optional<Trial> affordable_trial(const RemeshOptions& options) {
  Trial trial{"the method on-scan", options};
  trial.options.target.percent = 0.0;
  trial.options.measures = MeasureOptions();
  const auto* on_scan = std::get_if<OnScanOptions>(&options.method);
  OnScanOptions changed = on_scan != nullptr ? *on_scan : OnScanOptions();
  if (on_scan == nullptr) {
    trial.options.method = changed;
    return trial;
  }
  if (on_scan->placement == ScanPlacement::OnSurface) {
    trial.name = "fitted nodes";
    changed.placement = ScanPlacement::Fitted;
  } else if (on_scan->weighting == CellWeighting::ErrorAdaptive &&
             on_scan->edge_ratio >= closer_edge_ratio) {
    return {};  // the run itself
  } else {
    trial.name = "error-adaptive weighting";
    changed.weighting = CellWeighting::ErrorAdaptive;
    if (on_scan->edge_ratio < closer_edge_ratio) {
      changed.edge_ratio = closer_edge_ratio;
      trial.name += " and a mean edge ratio of " + format_number(closer_edge_ratio);
    }
  }
  trial.options.method = changed;
  return trial;
}

}  // namespace

std::vector<SuggestedSetting> suggest_settings(const RemeshOptions& options,
                                               const RemeshWith& remesh_with,
                                               const Execution& execution) {
  const std::optional<Trial> trial = affordable_trial(options);
  if (!trial) return {};
  try {
    const RemeshResult result = remesh_with(trial->options, execution);
    return {{trial->name, result.rms_distance / result.input.equivalent_radius,
             result.remesh.area / result.original.area - 1.0}};
  } catch (const Error& error) {
    // A setting that does not work is no suggestion.
    if (error.code() == ErrorCode::Cancelled) throw;
    return {};
  }
}

}  // namespace wscvt
