// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/exchange/clump_files.h"
#include "toolbox/volume/open_volume.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/carried_attributes.h"
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
        refuse_volume_input(path.string(), ways_of_volumes);
        if (!is_mesh_file(path.string()) && has_sphere_heading(path.string())) {
          refuse("\"" + path.string() +
                 "\" is a table of spheres, as of a clump, not a mesh. The program measures it: "
                 "wscvt describe CLUMP.csv SCAN.");
        }
        const IndexedMesh mesh = warned(read_mesh_file(path.string()));
        return std::make_pair(array_of(mesh.points), array_of(mesh.triangles));
      },
      py::arg("path"),
      ("Returns vertices (n, 3) float64 and faces (m, 3) int32 of a file that ends in " +
       mesh_extensions(MeshUse::Read) +
       ", also packed by gzip. Nothing is repaired. In STL each corner is a vertex. The last three "
       "formats have no faces. Problems of a file are UserWarnings.")
          .c_str());
}

namespace {

/// NumPy's names of the types, in the order of ScalarType.
constexpr std::array<const char*, 8> type_names{"int8",  "uint8",  "int16",   "uint16",
                                                "int32", "uint32", "float32", "float64"};

/// Returns the type in which a file keeps numbers of a NumPy type: whole numbers and truth values
/// stay whole, so that they are never mixed. Refuses those beyond 32 bits.
ScalarType kept_type(const std::string& name, const std::string& type,
                     const std::vector<double>& values) {
  for (std::size_t k = 0; k < type_names.size(); ++k) {
    if (type == type_names[k]) return static_cast<ScalarType>(k);
  }
  if (type == "bool") return ScalarType::Uint8;
  if (type != "int64" && type != "uint64") return ScalarType::Float64;
  double least = 0.0;
  double most = 0.0;
  for (const double value : values) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  if (least >= std::numeric_limits<std::int32_t>::min() &&
      most <= std::numeric_limits<std::int32_t>::max()) {
    return ScalarType::Int32;
  }
  if (least < 0.0 || most > std::numeric_limits<std::uint32_t>::max()) {
    refuse("The attribute \"" + name +
           "\" has whole numbers beyond 32 bits, which no mesh file keeps. Number its values anew, "
           "or give it as float64.");
  }
  return ScalarType::Uint32;
}

/// Reads attributes from a dictionary of arrays, one number per vertex or face.
std::vector<MeshAttribute> attributes_of(const py::dict& arrays) {
  std::vector<MeshAttribute> attributes;
  for (const auto& [name, array] : arrays) {
    MeshAttribute attribute{py::cast<std::string>(name), ScalarType::Float64, {}};
    // The name of a type does not tell the order of its bytes.
    const std::string type =
        py::str(py::module_::import("numpy").attr("asarray")(array).attr("dtype").attr("name"));
    const auto values = py::cast<Points>(array);
    if (values.ndim() != 1) {
      throw py::type_error("The attribute \"" + attribute.name +
                           "\" does not have the shape (n,). Give one number for each vertex or "
                           "face.");
    }
    attribute.values.assign(values.data(), values.data() + values.size());
    attribute.type = kept_type(attribute.name, type, attribute.values);
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

/// Integer types are rounded, as in a file.
py::dict arrays_of(const std::vector<MeshAttribute>& attributes) {
  py::dict arrays;
  for (const MeshAttribute& attribute : attributes) {
    py::object array = array_of(attribute.values);
    if (!holds_fractions(attribute.type)) array = array.attr("round")();
    arrays[py::str(attribute.name)] =
        array.attr("astype")(type_names[static_cast<std::size_t>(attribute.type)]);
  }
  return arrays;
}

py::tuple both(const MeshAttributes& attributes) {
  return py::make_tuple(arrays_of(attributes.of_vertices), arrays_of(attributes.of_faces));
}

py::tuple carry_attributes(const py::object& scan, const py::object& mesh,
                           const py::dict& of_vertices, const py::dict& of_faces, int threads) {
  const IndexedMesh from = mesh_of_reference(scan);
  const IndexedMesh to = mesh_of_reference(mesh);
  const MeshAttributes own{attributes_of(of_vertices), attributes_of(of_faces)};
  return both(work_on(threads, py::none(), [&](const Execution& execution) {
    return carried_attributes(from, own, to, execution);
  }));
}

void warn_all(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) warn(sentence);
}

py::tuple carry_attributes_of_file(const std::string& path, const py::object& mesh, int threads) {
  const IndexedMesh to = mesh_of_reference(mesh);
  std::vector<std::string> warnings;
  const MeshAttributes carried = work_on(threads, py::none(), [&](const Execution& execution) {
    MeshFile file = read_mesh_file(path, execution);
    file.warnings.clear();
    read_pictures(file, path, execution);
    warnings = file.warnings;
    return carried_attributes(file.mesh, file.attributes, to, execution);
  });
  warn_all(warnings);
  return both(carried);
}

/// Transfers the file's attributes to its own mesh, to turn a texture into vertex colours.
py::tuple read_attributes(const std::string& path) {
  MeshFile file = read_mesh_file(path);
  if (file.attributes.texture.empty()) return both(file.attributes);
  file.warnings.clear();
  read_pictures(file, path);
  warn_all(file.warnings);
  MeshAttributes texture;
  if (attribute_named(file.attributes.of_vertices, "red") == nullptr) {
    texture.texture = std::move(file.attributes.texture);
  }
  for (MeshAttribute& part : carried_attributes(file.mesh, texture, file.mesh).of_vertices) {
    file.attributes.of_vertices.push_back(std::move(part));
  }
  return both(file.attributes);
}

}  // namespace

void bind_attributes(py::module_& module) {
  module.def("read_attributes", &read_attributes, py::arg("path"),
             "Returns the attributes of vertices and faces of a PLY file, such as red, green, "
             "blue, quality or label, and the vertex colours of OBJ, as two dictionaries of arrays "
             "(n,). A texture becomes vertex colours. Both are empty for other formats.");
  module.def("carry_attributes_of_file", &carry_attributes_of_file, py::arg("path"),
             py::arg("mesh"), py::kw_only(), py::arg("threads") = 0);
  module.def("carry_attributes", &carry_attributes, py::arg("scan"), py::arg("mesh"),
             py::arg("vertex_attributes") = py::dict(), py::arg("face_attributes") = py::dict(),
             py::kw_only(), py::arg("threads") = 0,
             "Transfers the attributes of a scan's vertices and faces to another mesh at the same "
             "place, from the nearest point of the scan. scan and mesh: (vertices, faces). "
             "Returns two dictionaries with the same names; whole numbers stay whole, of up to 32 "
             "bits.");
  module.def(
      "write_mesh",
      [](const std::filesystem::path& path, const Points& vertices, const py::object& faces,
         const py::dict& of_vertices, const py::dict& of_faces) {
        write_mesh(mesh_of(vertices, faces), {attributes_of(of_vertices), attributes_of(of_faces)},
                   path.string());
      },
      py::arg("path"), py::arg("vertices"), py::arg("faces"), py::arg("vertex_attributes"),
      py::arg("face_attributes"),
      ("Writes a file by its ending, " + mesh_extensions(MeshUse::Write) +
       ", completely or not at all. Attributes are dictionaries of arrays (n,), a number for each "
       "vertex or face. Only PLY keeps them.")
          .c_str());
}

}  // namespace wscvt::python
