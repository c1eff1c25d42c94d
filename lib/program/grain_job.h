// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "batch_grains.h"
#include "batch_output.h"
#include "grain_run.h"
#include "wscvt/base/execution.h"

namespace wscvt::program {

/// Work on each grain of the inputs, with tables in an output folder. A job that was interrupted
/// continues after the last grain of its tables.
struct GrainJob {
  std::string call;                  ///< options that must be equal when the job is started again
  std::vector<std::string> headers;  ///< of the tables of each level: grains.csv, shape.csv
  bool writes_labels = false;        ///< of volumes, to labels.csv
  int threads = 0;                   ///< 0: all
  bool quiet = false;
  /// Makes a grain and returns its rows, on several threads at once; see row_or_failure.
  std::function<GrainRow(std::size_t grain, const Execution& execution)> work;
};

/// Creates the folder, checks that it is of the same call, and runs the job. Throws WrongCall if
/// files would replace each other or the folder is of another call, and as run_grains.
GrainRunEnd run_job(const GrainJob& job, BatchGrains& inputs, BatchOutput& output);

}  // namespace wscvt::program
