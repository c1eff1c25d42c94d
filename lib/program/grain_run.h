// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "grain_queue.h"
#include "wscvt/base/execution.h"

namespace wscvt::program {

/// Many grains to be worked on: one a thread, with a line on a terminal that says how far it is,
/// and signals that cancel.
struct GrainRun {
  std::size_t first = 0;   ///< those before are done
  std::size_t failed = 0;  ///< of them
  std::size_t count = 0;
  int threads = 0;  ///< 0: all
  bool quiet = false;
  /// What to know of a run that was stopped; follows the sentence that says why it was.
  std::string when_stopped;
  std::function<std::string(std::size_t grain)> name;
  /// Makes a grain, on several threads at once. What it throws as Error(Cancelled) ends the run.
  std::function<GrainRow(std::size_t grain, const Execution& execution)> work;
  /// Takes the rows in the order of the grains, on one thread at a time.
  std::function<void(std::size_t grain, const GrainRow& row)> take;
};

/// How far a run came.
struct GrainRunEnd {
  std::size_t done = 0;
  std::size_t failed = 0;
  bool was_cancelled = false;  ///< which the standard error then says
};

/// Works on the grains. Failures go to the standard error. Throws Error, with a sentence that ends
/// with `when_stopped`, where `work` or `take` throw: the run is stopped there.
GrainRunEnd run_grains(const GrainRun& run);

/// The row of a grain: what `make` gives, or `failed` of the sentence of what it throws. It throws
/// on what is not about the grain: Error(Cancelled), MachineRefused and std::bad_alloc.
GrainRow row_or_failure(const std::function<GrainRow()>& make,
                        const std::function<GrainRow(const std::string& sentence)>& failed);

}  // namespace wscvt::program
