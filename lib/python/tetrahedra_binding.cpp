// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/exchange/tetrahedra_files.h"
#include "toolbox/tetrahedra/tetrahedra.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::array_t<std::int32_t> corners_of(const TetrahedralMesh& mesh) {
  py::array_t<std::int32_t> corners(
      {static_cast<py::ssize_t>(mesh.tetrahedra.size()), py::ssize_t{4}});
  std::int32_t* next = corners.mutable_data();
  for (const Tetrahedron& t : mesh.tetrahedra) next = std::copy(t.begin(), t.end(), next);
  return corners;
}

py::dict tetrahedra(const Points& vertices, const py::object& faces, double edge_length,
                    const std::optional<std::filesystem::path>& output, int threads,
                    const py::object& progress) {
  if (output) check_tetrahedra_file(output->string());
  IndexedMesh surface = mesh_of(vertices, faces);
  const TetrahedralMesh mesh = work_on(threads, progress, [&](const Execution& execution) {
    TetrahedralMesh made = tetrahedra_in(std::move(surface), edge_length, execution);
    if (output) write_tetrahedra(output->string(), made);
    return made;
  });
  py::dict result;
  result["vertices"] = array_of(mesh.surface.points);
  result["tetrahedra"] = corners_of(mesh);
  result["faces"] = array_of(mesh.surface.triangles);
  result["smallest_dihedral_degrees"] = mesh.smallest_dihedral;
  result["largest_dihedral_degrees"] = mesh.largest_dihedral;
  result["mean_edge"] = mesh.mean_edge;
  return result;
}

}  // namespace

// wscvt/__init__.py documents the arguments and the result.
void bind_tetrahedra(py::module_& module) {
  module.def("tetrahedra", &tetrahedra, py::arg("vertices"), py::arg("faces"), py::kw_only(),
             py::arg("edge_length") = 0.0, py::arg("output") = py::none(), py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
