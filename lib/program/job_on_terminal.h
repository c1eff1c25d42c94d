// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "toolbox/job/grain_job.h"

namespace wscvt::program {

// Work on many grains, with a progress line on a terminal unless quiet. Failures are printed to the
// standard error, and so is a run that a signal cancelled. `threads`: 0 uses all.

JobEnd on_terminal(int threads, bool quiet, const std::function<JobEnd(const JobHost&)>& run);

JobEnd run_grains(const GrainRun& run, int threads, bool quiet);

/// Throws WrongCall if files would replace each other, or the folder is of another call.
JobEnd run_job(const GrainJob& job, GrainSource& grains, int threads, bool quiet);

/// "40 grains, 1 failed: out/grains.csv".
std::string end_line(const GrainJob& job, const JobEnd& end);

}  // namespace wscvt::program
