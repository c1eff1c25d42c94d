// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/convex/convex_parts.h"
#include "toolbox/job/engine_jobs.h"
#include "toolbox/report/parts_report.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::tuple convex(const Points& vertices, const py::object& triangles, int count, int faces,
                 double max_error, int threads, const py::object& progress,
                 const py::kwargs& given) {
  const RemeshOptions remesh_options = options_of(given, "convex");
  const ConvexOptions options{count, faces, max_error};
  IndexedMesh scan = mesh_of(vertices, triangles);
  const PartsResult result = work_on(threads, progress, [&](const Execution& execution) {
    return make_parts(std::move(scan), remesh_options, options, execution);
  });
  py::list list;
  for (const IndexedMesh& part : result.parts) {
    list.append(py::make_tuple(array_of(part.points), array_of(part.triangles)));
  }
  return py::make_tuple(list, parsed(parts_json(result)));
}

py::dict convex_files(const std::vector<std::string>& inputs, const std::filesystem::path& output,
                      const std::string& shard, const std::string& format, const std::string& frame,
                      double scale, double size, double density, int count, int faces,
                      double max_error, int threads, const py::object& progress,
                      const py::kwargs& given) {
  ConvexJob options;
  options.remesh = options_of(given, "convex");
  options.convex = {count, faces, max_error};
  options.frame = frame_of(frame, scale, size);
  options.density = density;
  options.format = format;
  check_job(options);
  GrainJob job = make_job(options, output.string(), shard_of(shard));
  return run_job_on(inputs, job, threads, progress);
}

}  // namespace

// wscvt/__init__.py documents the arguments and results of these functions.
void bind_convex(py::module_& module) {
  const ConvexOptions usual;
  module.def("convex", &convex, py::arg("vertices"), py::arg("triangles"), py::kw_only(),
             py::arg("count").noconvert() = usual.parts, py::arg("faces").noconvert() = usual.faces,
             py::arg("max_error") = usual.tolerance, py::arg("threads") = 0,
             py::arg("progress") = py::none());
  module.def("_convex_files", &convex_files, py::arg("inputs"), py::arg("output"), py::kw_only(),
             py::arg("shard") = "1/1", py::arg("format") = "obj", py::arg("frame") = "input",
             py::arg("scale") = 1.0, py::arg("size") = 0.0, py::arg("density") = 1.0,
             py::arg("count").noconvert() = usual.parts, py::arg("faces").noconvert() = usual.faces,
             py::arg("max_error") = usual.tolerance, py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
