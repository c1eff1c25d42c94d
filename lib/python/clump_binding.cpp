// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/clump/clump.h"
#include "toolbox/job/engine_jobs.h"
#include "toolbox/report/clump_report.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::object clump(const Points& vertices, const py::object& faces, int threads,
                 const py::object& progress, const py::kwargs& given) {
  const ClumpOptions options = clump_options_of(given);
  IndexedMesh scan = mesh_of(vertices, faces);
  const ClumpResult result = work_on(threads, progress, [&](const Execution& execution) {
    return make_clump(std::move(scan), options, execution);
  });
  py::object report = parsed(clump_json(result));
  report["spheres"] = column(result.spheres, [](const Sphere& s) {
    return std::array{s.centre.x(), s.centre.y(), s.centre.z(), s.radius};
  });
  return report;
}

py::dict clump_files(const std::vector<std::string>& inputs, const std::filesystem::path& output,
                     const std::string& shard, const std::string& format, const std::string& frame,
                     double scale, double size, double density, int threads,
                     const py::object& progress, const py::kwargs& given) {
  ClumpJob options;
  options.clump = clump_options_of(given);
  options.frame = frame_of(frame, scale, size);
  options.density = density;
  options.format = format;
  check_job(options);
  GrainJob job = make_job(options, output.string(), shard_of(shard));
  return run_job_on(inputs, job, threads, progress);
}

}  // namespace

// wscvt/__init__.py documents the arguments and results of these functions.
void bind_clump(py::module_& module) {
  module.def("clump", &clump, py::arg("vertices"), py::arg("faces"), py::kw_only(),
             py::arg("threads") = 0, py::arg("progress") = py::none());
  module.def("_clump_files", &clump_files, py::arg("inputs"), py::arg("output"), py::kw_only(),
             py::arg("shard") = "1/1", py::arg("format") = "csv", py::arg("frame") = "input",
             py::arg("scale") = 1.0, py::arg("size") = 0.0, py::arg("density") = 1.0,
             py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
