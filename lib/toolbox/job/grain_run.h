// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// Result of a grain.
struct GrainRow {
  std::vector<std::string> records;  ///< of tables, in the order of the tables
  std::string error = {};            ///< the message of a failure; empty: no failure
};

/// State of a run on many grains.
struct JobProgress {
  std::size_t first = 0;   ///< grains that were done before the run
  std::size_t done = 0;    ///< grains, these included
  std::size_t failed = 0;  ///< of the grains that are done
  std::size_t count = 0;   ///< of all grains
};

/// What a run needs from its caller. Each function may be empty.
struct JobHost {
  int threads = 0;  ///< one grain per thread; 0: all of the machine
  /// Called on the caller's thread before the first grain, then about five times per second, or
  /// after each grain if no thread starts. False stops the run.
  std::function<bool(const JobProgress& progress)> progress = {};
  /// Whether to stop. Called often, on several threads at once.
  std::function<bool()> is_cancelled = {};
  /// Takes a failed grain and its message, in the order of the grains, on one thread at a time.
  std::function<void(const std::string& grain, const std::string& error)> failed = {};
};

/// Work on many grains, one grain per thread.
struct GrainRun {
  std::size_t first = 0;   ///< earlier grains are done
  std::size_t failed = 0;  ///< of the earlier grains
  std::size_t count = 0;
  /// Message for a stopped run; follows the reason.
  std::string when_stopped;
  std::function<std::string(std::size_t grain)> name;
  /// Makes a grain, on several threads at once; see row_or_failure. Error(Cancelled) ends the run.
  std::function<GrainRow(std::size_t grain, const Execution& execution)> work;
  /// Takes the rows in the order of the grains, on one thread at a time. May be empty.
  std::function<void(std::size_t grain, const GrainRow& row)> take = {};
};

/// Result of a run.
struct JobEnd {
  std::size_t done = 0;    ///< grains
  std::size_t failed = 0;  ///< of these
  std::size_t count = 0;   ///< of all grains
  std::string when_stopped = {};

  bool was_cancelled() const { return done < count; }
};

/// Works on the grains. The order of the rows does not depend on the number of threads, which is as
/// many as the system starts. Few rows wait for an earlier row, because grains far ahead of it are
/// not begun. If memory is not enough for a grain, tries it again while no other grain is worked
/// on. If `work` or `take` throw, stops the run and throws Error(InputOutput) with a message that
/// ends with `when_stopped`. A cancelled run returns.
JobEnd run_grains(const GrainRun& run, const JobHost& host);

/// Returns the row of a grain: the result of `make`, or, if `make` throws, `failed` with its
/// message. Passes on exceptions that do not concern the grain: Error(Cancelled), MachineRefused
/// and std::bad_alloc.
GrainRow row_or_failure(const std::function<GrainRow()>& make,
                        const std::function<GrainRow(const std::string& error)>& failed);

}  // namespace wscvt
