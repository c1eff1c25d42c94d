// SPDX-License-Identifier: GPL-3.0-or-later
// Jobs on the grains of files, into a folder; here that of "wscvt batch".
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "option_arguments.h"
#include "toolbox/job/remesh_job.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::python {

namespace py = pybind11;

py::dict run_job_on(const std::vector<std::string>& inputs, const GrainJob& job, int threads,
                    const py::object& progress) {
  JoinedGrains grains(job.shard);
  for (const std::string& file : grain_files(inputs, {})) {
    check_mesh_format(file, MeshUse::Read);
    grains.add(std::make_unique<MeshGrains>(file));
  }
  std::vector<std::string> failures;
  const JobEnd end = work_on(threads, progress, [&](const Execution& execution) {
    JobHost host;
    host.threads = threads;
    host.progress = [&](const JobProgress& now) {
      const double count = static_cast<double>(now.count);
      const double fraction = now.count == 0 ? 1.0 : static_cast<double>(now.done) / count;
      try {
        execution.report(fraction,
                         std::to_string(now.done) + " of " + std::to_string(now.count) + " grains");
      } catch (const Error&) {
        return false;
      }
      return true;
    };
    host.failed = [&](const std::string& grain, const std::string& error) {
      failures.push_back(grain + ": " + error);
    };
    JobEnd done = run_job(job, grains, host);
    if (done.was_cancelled()) {
      throw Error(ErrorCode::Cancelled, "Cancelled after " + std::to_string(done.done) + " of " +
                                            std::to_string(done.count) + " grains. " +
                                            done.when_stopped);
    }
    return done;
  });
  for (const std::string& failure : failures) warn(failure);
  py::dict counts;
  counts["grains"] = end.done;
  counts["failed"] = end.failed;
  return counts;
}

FrameOptions frame_of(const std::string& name, double scale, double size) {
  return {value_of_name<Frame>(name), scale, size};
}

namespace {

py::dict batch(const std::vector<std::string>& inputs, const std::filesystem::path& output,
               const std::string& shard, const std::string& format, const std::string& describe,
               bool contacts, bool seconds, const std::string& frame, double scale, double size,
               const std::vector<std::string>& node_table, const std::vector<std::string>& sdf,
               const std::string& sdf_surface, double sdf_spacing, const std::vector<int>& levels,
               int threads, const py::object& progress, const py::kwargs& given) {
  RemeshJob options;
  options.remesh = options_of(given, {});
  options.levels = levels;
  options.shapes.described = value_of_name<Described>(describe);
  options.shapes.contacts = contacts;
  options.format = format;
  options.seconds = seconds;
  options.simulation.frame = frame_of(frame, scale, size);
  options.simulation.surface = value_of_name<GridSurface>(sdf_surface);
  options.simulation.grid.spacing = sdf_spacing;
  options.node_tables = node_table;
  options.grids = sdf;
  check_job(options);
  const GrainJob job = make_job(options, output.string(), shard_of(shard));
  const py::dict counts = run_job_on(inputs, job, threads, progress);
  write_summaries(job);
  return counts;
}

}  // namespace

// wscvt/__init__.py documents the arguments.
void bind_job(py::module_& module) {
  const RemeshJob usual;
  module.def(
      "_batch", &batch, py::arg("inputs"), py::arg("output"), py::kw_only(),
      py::arg("shard") = "1/1", py::arg("format") = usual.format,
      py::arg("describe") = key_of(usual.shapes.described), py::arg("contacts") = false,
      py::arg("seconds") = false, py::arg("frame") = key_of(usual.simulation.frame.frame),
      py::arg("scale") = usual.simulation.frame.scale,
      py::arg("size") = usual.simulation.frame.size, py::arg("node_table") = usual.node_tables,
      py::arg("sdf") = usual.grids, py::arg("sdf_surface") = key_of(usual.simulation.surface),
      py::arg("sdf_spacing") = usual.simulation.grid.spacing, py::arg("levels") = usual.levels,
      py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
