// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>

#include "bindings.h"
#include "conversion.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// Reads a mesh. Warnings about the file become Python warnings.
IndexedMesh warned(MeshFile file) {
  for (const std::string& warning : file.warnings) warn(warning);
  return std::move(file.mesh);
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("_is_mesh_file", &is_mesh_file);
  module.def(
      "read_mesh",
      [](const std::filesystem::path& path) {
        const IndexedMesh mesh = warned(read_mesh_file(path.string()));
        return std::make_pair(array_of(mesh.points), array_of(mesh.triangles));
      },
      py::arg("path"),
      ("Returns vertices (n, 3) float64 and faces (m, 3) int32 of a file that ends in " +
       mesh_extensions(MeshUse::Read) +
       ", also packed by gzip. Nothing is repaired. In STL each corner is a vertex. The last three "
       "formats have no faces. Problems of a file are UserWarnings.")
          .c_str());
  module.def(
      "write_mesh",
      [](const std::filesystem::path& path, const Points& vertices, const py::object& faces) {
        write_mesh(mesh_of(vertices, faces), path.string());
      },
      py::arg("path"), py::arg("vertices"), py::arg("faces"),
      ("Writes a file by its ending, " + mesh_extensions(MeshUse::Write) +
       ", completely or not at all.")
          .c_str());
}

}  // namespace wscvt::python
