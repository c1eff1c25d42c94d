// SPDX-License-Identifier: GPL-3.0-or-later
// Jobs on the grains of files, into a folder; here that of "wscvt batch".
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/job/label_source.h"
#include "toolbox/job/remesh_job.h"
#include "toolbox/volume/open_volume.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::python {

namespace py = pybind11;

JobHost host_of(int threads, const Execution& execution) {
  JobHost host;
  host.threads = threads;
  host.progress = [&execution](const JobProgress& now) {
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
  return host;
}

void check_end(const JobEnd& end) {
  if (!end.was_cancelled()) return;
  throw Error(ErrorCode::Cancelled, "Cancelled after " + std::to_string(end.done) + " of " +
                                        std::to_string(end.count) + " grains. " + end.when_stopped);
}

namespace {

/// Opens the files of a job. Adds what is said about reading them to `warnings`.
void open_files(const std::vector<std::string>& files, const VolumeOptions& options,
                JoinedGrains& grains, std::vector<Sentence>& warnings, const Execution& execution) {
  for (const std::string& file : files) {
    if (is_volume(file)) {
      auto labels = std::make_unique<LabelGrains>(file, options, execution);
      warnings.insert(warnings.end(), labels->warnings().begin(), labels->warnings().end());
      grains.add(std::make_unique<LabelSource>(file, std::move(labels)));
    } else if (options.parts) {
      auto bodies = std::make_unique<MeshGrains>(file, execution);
      const auto& said = bodies->bodies().warnings;
      warnings.insert(warnings.end(), said.begin(), said.end());
      grains.add(std::move(bodies));
    } else {
      check_mesh_format(file, MeshUse::Read);
      grains.add(std::make_unique<MeshGrains>(file));
    }
  }
}

}  // namespace

py::dict run_job_on(const std::vector<std::string>& inputs, GrainJob& job, int threads,
                    const py::object& progress, const VolumeOptions& volume) {
  JoinedGrains grains(job.shard);
  std::vector<Sentence> warnings;
  const std::vector<std::string> files = grain_files(inputs, is_volume);
  const JobEnd end = work_on(threads, progress, [&](const Execution& execution) {
    open_files(files, volume, grains, warnings, execution.part(0.0, 0.1));
    job.long_names = grains.volumes() > 1;
    const Execution working = execution.part(0.1, 1.0);
    JobHost host = host_of(threads, working);
    host.failed = [&](const std::string& grain, const std::string& error) {
      warnings.push_back(grain + ": " + error);
    };
    JobEnd done = run_job(job, grains, host);
    check_end(done);
    return done;
  });
  for (const Sentence& warning : warnings) warn(warning);
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
               const std::string& frame, double scale, double size,
               const std::vector<std::string>& node_table, const std::vector<std::string>& sdf,
               double sdf_spacing, const std::vector<int>& levels,
               std::optional<std::array<double, 3>> voxel_size, std::int64_t smallest,
               int smoothing, double background, bool at_border, bool parts,
               std::optional<double> separate, int threads, const py::object& progress,
               const py::kwargs& given) {
  RemeshJob options;
  VolumeOptions& volume = options.volume;
  if (voxel_size) volume.choice.voxel_size = Vector3(voxel_size->data());
  volume.smallest = smallest;
  volume.smoothing = smoothing;
  volume.background = background;
  volume.at_border = at_border;
  volume.parts = parts;
  volume.separate = separate;
  options.remesh = options_of(given, "batch");
  options.levels = levels;
  options.shapes.described = value_of_name<Described>(describe);
  options.shapes.contacts = options.shapes.described == Described::Contacts;
  options.format = format;
  options.simulation.frame = frame_of(frame, scale, size);
  options.simulation.grid.spacing = sdf_spacing;
  options.node_tables = node_table;
  options.grids = sdf;
  check_job(options);
  check_volume_options(volume);
  const std::vector<std::string> files = grain_files(inputs, is_volume);
  options.shapes.resolution = describes_scan(options.shapes.described) &&
                              (voxel_size || std::any_of(files.begin(), files.end(), is_volume));
  GrainJob job = make_job(options, output.string(), shard_of(shard));
  py::dict counts = run_job_on(inputs, job, threads, progress, volume);
  write_summaries(job, Execution(threads));
  return counts;
}

}  // namespace

// wscvt/__init__.py documents the arguments.
void bind_job(py::module_& module) {
  const RemeshJob usual;
  module.def(
      "_batch", &batch, py::arg("inputs"), py::arg("output"), py::kw_only(),
      py::arg("shard") = "1/1", py::arg("format") = usual.format,
      py::arg("describe") = key_of(usual.shapes.described),
      py::arg("frame") = key_of(usual.simulation.frame.frame),
      py::arg("scale") = usual.simulation.frame.scale,
      py::arg("size") = usual.simulation.frame.size, py::arg("node_table") = usual.node_tables,
      py::arg("sdf") = usual.grids, py::arg("sdf_spacing") = usual.simulation.grid.spacing,
      py::arg("levels").noconvert() = usual.levels, py::arg("voxel_size") = py::none(),
      py::arg("smallest") = usual.volume.smallest, py::arg("smoothing") = usual.volume.smoothing,
      py::arg("background") = usual.volume.background,
      py::arg("at_border") = usual.volume.at_border, py::arg("parts") = usual.volume.parts,
      py::arg("separate") = py::none(), py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
