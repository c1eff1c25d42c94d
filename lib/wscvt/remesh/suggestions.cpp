// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/suggestions.h"

#include <algorithm>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/repair/closing_advice.h"

namespace wscvt {

namespace {

/// A setting to try.
struct Trial {
  std::string name;
  RemeshOptions options;
  /// Least work it needs, see Execution::work.
  std::uint64_t least_work = 0;
};

/// Work per node of equalization and fit: 1,900 elements at the default edge ratio, 5,000 at 1.4.
constexpr std::uint64_t fitted_work = 1900;
constexpr std::uint64_t closer_work = 5000;

/// An element of placing nodes takes up to twice as long as one of a complete run, much of which is
/// reading and checking the scan.
constexpr std::uint64_t cost_of_placing = 2;

/// A large edge ratio, at which triangles are close and still even.
constexpr double closer_edge_ratio = 1.4;

/// Returns the setting with as many nodes that helps most. Only one is tried, because all together
/// may cost as much as the run.
std::optional<Trial> best_trial(const RemeshOptions& options) {
  const auto nodes = static_cast<std::uint64_t>(options.node_count);
  Trial trial{"the method on-scan", options, fitted_work * nodes};
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
  } else if (on_scan->weighting == CellWeighting::Area &&
             on_scan->edge_ratio >= closer_edge_ratio) {
    return {};  // the run itself
  } else {
    trial.name = "a mean edge ratio of " + format_number(closer_edge_ratio);
    trial.least_work = closer_work * nodes;
    if (on_scan->weighting != CellWeighting::Area) trial.name = "wscvt-d and " + trial.name;
    changed.weighting = CellWeighting::Area;
    changed.edge_ratio = std::max(on_scan->edge_ratio, closer_edge_ratio);
  }
  trial.options.method = changed;
  return trial;
}

}  // namespace

std::vector<SuggestedSetting> suggest_settings(const RemeshOptions& options, std::uint64_t run_work,
                                               const RemeshWith& remesh_with,
                                               const Execution& execution) {
  const std::optional<Trial> trial = best_trial(options);
  const std::uint64_t most = run_work / cost_of_placing;
  if (!trial || trial->least_work > most) return {};
  try {
    const RemeshResult result = remesh_with(trial->options, execution.counted(most));
    return {{trial->name, result.rms_distance / result.input.equivalent_radius,
             result.remesh.area / result.original.area - 1.0}};
  } catch (const WorkExceeded&) {
    return {};
  } catch (const Error& error) {
    // A setting that fails is no suggestion.
    if (error.code() == ErrorCode::Cancelled) throw;
    return {};
  }
}

std::optional<double> working_opening(RemeshOptions options, double first,
                                      const RemeshWith& remesh_with, const Execution& execution) {
  options.target.percent = 0.0;
  options.measures = MeasureOptions();
  options.measures.suggestions = false;
  for (double percent = first; percent <= coarsest_tried_percent; percent *= 2.0) {
    options.envelope.opening_percent = percent;
    try {
      remesh_with(options, execution);
      return percent;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::Cancelled) throw;
    }
  }
  return std::nullopt;
}

}  // namespace wscvt
