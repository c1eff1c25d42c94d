// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the library for Python, with progress, Ctrl-C and other threads of the interpreter.
#ifndef WSCVT_PYTHON_WORK_H_
#define WSCVT_PYTHON_WORK_H_

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <vector>

#include "toolbox/exchange/simulation_options.h"
#include "toolbox/job/grain_job.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"

namespace wscvt::python {

/// Whether the work continues. Throws TypeError for answers of other types.
bool goes_on(const pybind11::object& answer);

/// Runs `work` without the interpreter's lock. An exception of the progress callback, or Ctrl-C,
/// cancels it and is passed to the caller.
template <class Work>
auto work_on(int threads, const pybind11::object& progress, const Work& work) {
  std::exception_ptr thrown;
  const auto callback = [&](double fraction, const std::string& stage) {
    const pybind11::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      if (progress.is_none()) return true;
      return goes_on(progress(fraction, stage));
    } catch (...) {
      thrown = std::current_exception();
      return false;
    }
  };
  try {
    const Execution execution(threads, callback);
    const pybind11::gil_scoped_release unlocked;
    return work(execution);
  } catch (const Error&) {
    if (thrown) std::rethrow_exception(thrown);
    throw;
  }
}

/// Returns what a run on many grains needs. `execution` must outlive it.
JobHost host_of(int threads, const Execution& execution);

/// Throws Error(Cancelled) for a run that was cancelled.
void check_end(const JobEnd& end);

/// Runs a job on mesh files, volumes of labels, folders, patterns and lists. Failed grains become
/// Python warnings. Sets GrainJob::long_names. Returns the numbers of grains and of failures.
pybind11::dict run_job_on(const std::vector<std::string>& inputs, GrainJob& job, int threads,
                          const pybind11::object& progress, const VolumeOptions& volume = {});

/// Returns the frame of files. Throws Error for an unknown name.
FrameOptions frame_of(const std::string& name, double scale, double size);

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_WORK_H_
