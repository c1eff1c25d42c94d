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
#include "toolbox/clump/clump.h"
#include "toolbox/job/engine_jobs.h"
#include "toolbox/report/clump_report.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::array_t<double> array_of_spheres(const std::vector<Sphere>& spheres) {
  py::array_t<double> array({static_cast<py::ssize_t>(spheres.size()), py::ssize_t{4}});
  auto rows = array.mutable_unchecked<2>();
  for (py::ssize_t k = 0; k < rows.shape(0); ++k) {
    const Sphere& sphere = spheres[static_cast<std::size_t>(k)];
    for (py::ssize_t axis = 0; axis < 3; ++axis) rows(k, axis) = sphere.centre[axis];
    rows(k, 3) = sphere.radius;
  }
  return array;
}

ClumpOptions clump_options(int spheres, double max_error, const std::string& error_measure,
                           int max_spheres, double smallest_radius, bool inside, int remesh_nodes) {
  ClumpOptions options;
  options.sphere_count = spheres;
  options.max_error_percent = max_error;
  options.error_measure = from_key<ClumpError>(lower_case(error_measure));
  options.most_spheres = max_spheres;
  options.smallest_radius_percent = smallest_radius;
  options.inside = inside;
  options.compared_nodes = remesh_nodes;
  return options;
}

py::object clump(const Points& vertices, const py::object& faces, int spheres, double max_error,
                 const std::string& error_measure, int max_spheres, double smallest_radius,
                 bool inside, int remesh_nodes, int threads, const py::object& progress) {
  const ClumpOptions options = clump_options(spheres, max_error, error_measure, max_spheres,
                                             smallest_radius, inside, remesh_nodes);
  IndexedMesh scan = mesh_of(vertices, faces);
  const ClumpResult result = work_on(threads, progress, [&](const Execution& execution) {
    return make_clump(std::move(scan), options, execution);
  });
  py::object report = parsed(clump_json(result));
  report["spheres"] = array_of_spheres(result.spheres);
  return report;
}

py::dict clump_files(const std::vector<std::string>& inputs, const std::filesystem::path& output,
                     int spheres, const std::string& shard, const std::string& format,
                     const std::string& frame, double scale, double size, double density,
                     double max_error, const std::string& error_measure, int max_spheres,
                     double smallest_radius, bool inside, int remesh_nodes, int threads,
                     const py::object& progress) {
  ClumpJob options;
  options.clump = clump_options(spheres, max_error, error_measure, max_spheres, smallest_radius,
                                inside, remesh_nodes);
  options.frame = frame_of(frame, scale, size);
  options.density = density;
  options.format = format;
  check_job(options);
  GrainJob job = make_job(options, output.string(), shard_of(shard));
  return run_job_on(inputs, job, threads, progress);
}

}  // namespace

void bind_clump(py::module_& module) {
  const ClumpOptions usual;
  module.def(
      "clump", &clump, py::arg("vertices"), py::arg("faces"),
      py::arg("spheres").noconvert() = usual.sphere_count, py::kw_only(),
      py::arg("max_error") = usual.max_error_percent, py::arg("error_measure") = "distance",
      py::arg("max_spheres") = usual.most_spheres,
      py::arg("smallest_radius") = usual.smallest_radius_percent, py::arg("inside") = usual.inside,
      py::arg("remesh_nodes") = usual.compared_nodes, py::arg("threads") = 0,
      py::arg("progress") = py::none(),
      "Fits overlapping spheres to a grain. Returns the dictionary of the JSON report, with "
      "spheres as an array (k, 4) of x, y, z and radius. max_error is in %, smallest_radius in % "
      "of the equivalent radius. Arrays as for remesh. Lengths are in the unit of the mesh.");
  module.def("_clump_files", &clump_files, py::arg("inputs"), py::arg("output"), py::arg("spheres"),
             py::kw_only(), py::arg("shard") = "1/1", py::arg("format") = "csv",
             py::arg("frame") = "input", py::arg("scale") = 1.0, py::arg("size") = 0.0,
             py::arg("density") = 1.0, py::arg("max_error") = usual.max_error_percent,
             py::arg("error_measure") = "distance", py::arg("max_spheres") = usual.most_spheres,
             py::arg("smallest_radius") = usual.smallest_radius_percent,
             py::arg("inside") = usual.inside, py::arg("remesh_nodes") = usual.compared_nodes,
             py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
