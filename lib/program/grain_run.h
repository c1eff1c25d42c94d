// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "grain_queue.h"
#include "wscvt/base/execution.h"

namespace wscvt::program {

/// Work on many grains, one grain per thread, with a progress line on a terminal. Signals cancel
/// it.
struct GrainRun {
  std::size_t first = 0;   ///< earlier grains are done
  std::size_t failed = 0;  ///< of the earlier grains
  std::size_t count = 0;
  int threads = 0;  ///< 0: all
  bool quiet = false;
  /// Message for a stopped run; follows the reason.
  std::string when_stopped;
  std::function<std::string(std::size_t grain)> name;
  /// Makes a grain, on several threads at once. Error(Cancelled) ends the run.
  std::function<GrainRow(std::size_t grain, const Execution& execution)> work;
  /// Takes the rows in the order of the grains, on one thread at a time.
  std::function<void(std::size_t grain, const GrainRow& row)> take;
};

/// Result of a run.
struct GrainRunEnd {
  std::size_t done = 0;
  std::size_t failed = 0;
  bool was_cancelled = false;  ///< then reported on the standard error
};

/// Works on the grains. Writes failures to the standard error. If `work` or `take` throw, stops the
/// run and throws Error with a message that ends with `when_stopped`.
GrainRunEnd run_grains(const GrainRun& run);

/// Returns the row of a grain: the result of `make`, or, if `make` throws, `failed` with its
/// message. Passes on exceptions that do not concern the grain: Error(Cancelled), MachineRefused
/// and std::bad_alloc.
GrainRow row_or_failure(const std::function<GrainRow()>& make,
                        const std::function<GrainRow(const std::string& sentence)>& failed);

}  // namespace wscvt::program
