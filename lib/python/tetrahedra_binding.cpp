// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/exchange/tetrahedra_files.h"
#include "toolbox/tetrahedra/tetrahedra.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::dict filled(const std::function<TetrahedralMesh(const Execution&)>& fill,
                const std::optional<std::filesystem::path>& output, int threads,
                const py::object& progress) {
  if (output) check_tetrahedra_file(output->string());
  const TetrahedralMesh mesh = work_on(threads, progress, [&](const Execution& execution) {
    TetrahedralMesh made = fill(execution);
    if (output) write_tetrahedra(output->string(), made);
    return made;
  });
  py::dict result;
  if (!mesh.names.empty()) result["bodies"] = array_of(mesh.bodies);
  result["vertices"] = array_of(mesh.surface.points);
  result["tetrahedra"] = array_of(mesh.tetrahedra);
  result["faces"] = array_of(mesh.surface.triangles);
  result["smallest_dihedral_degrees"] = mesh.smallest_dihedral;
  result["largest_dihedral_degrees"] = mesh.largest_dihedral;
  result["mean_edge"] = mesh.mean_edge;
  return result;
}

py::dict tetrahedra(const Points& vertices, const py::object& faces, double edge_length,
                    const std::optional<std::filesystem::path>& output, int threads,
                    const py::object& progress) {
  const IndexedMesh surface = mesh_of(vertices, faces);
  return filled(
      [&](const Execution& execution) { return tetrahedra_in(surface, edge_length, execution); },
      output, threads, progress);
}

py::dict tetrahedra_of_bodies(const std::vector<py::object>& meshes, const std::string& kind,
                              const std::vector<std::string>& names, double edge_length,
                              const std::optional<std::filesystem::path>& output, int threads,
                              const py::object& progress) {
  std::vector<IndexedMesh> bodies;
  for (const py::object& mesh : meshes) bodies.push_back(mesh_of_reference(mesh));
  return filled(
      [&](const Execution& execution) {
        return tetrahedra_in(bodies, kind, names, edge_length, execution);
      },
      output, threads, progress);
}

}  // namespace

// wscvt/__init__.py documents the arguments and the result.
void bind_tetrahedra(py::module_& module) {
  module.def("tetrahedra", &tetrahedra, py::arg("vertices"), py::arg("faces"), py::kw_only(),
             py::arg("edge_length") = 0.0, py::arg("output") = py::none(), py::arg("threads") = 0,
             py::arg("progress") = py::none());
  module.def("tetrahedra_of_bodies", &tetrahedra_of_bodies, py::arg("meshes"), py::arg("kind"),
             py::arg("names"), py::kw_only(), py::arg("edge_length") = 0.0,
             py::arg("output") = py::none(), py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
