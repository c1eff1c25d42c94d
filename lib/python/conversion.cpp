// SPDX-License-Identifier: GPL-3.0-or-later
#include "conversion.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "toolbox/volume/label_grains.h"
#include "toolbox/volume/open_volume.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"

namespace wscvt::python {

namespace py = pybind11;

std::string type_name_of(const py::handle& value) {
  return py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>();
}

std::vector<Vector3> points_of(const Points& vertices) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3) {
    refuse("The vertices do not have the shape (n, 3). Give one row of x, y and z per vertex.");
  }
  std::vector<Vector3> points(static_cast<std::size_t>(vertices.shape(0)));
  const auto rows = vertices.unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    points[i] = Vector3(rows(row, 0), rows(row, 1), rows(row, 2));
  }
  return points;
}

IndexedMesh mesh_of(const Points& vertices, const py::object& faces) {
  IndexedMesh mesh;
  mesh.points = points_of(vertices);
  if (faces.is_none()) return mesh;
  const auto array = py::array::ensure(faces);
  // NumPy would silently cut off decimals.
  if (!array || (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')) {
    throw py::type_error(
        "The faces are not whole numbers. Give the indices of three vertices per row.");
  }
  if (array.ndim() != 2 || array.shape(1) != 3) {
    refuse(
        "The faces do not have the shape (n, 3). Give one row of three indices per triangle. For "
        "PyVista, use mesh.regular_faces of a triangulated mesh.");
  }
  const auto indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(array);
  const auto rows = indices.unchecked<2>();
  mesh.triangles.resize(static_cast<std::size_t>(indices.shape(0)));
  const auto count = static_cast<std::int64_t>(mesh.points.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::int64_t index =
          rows(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(corner));
      if (index < 0 || index >= count) {
        refuse("Face " + std::to_string(i) + " has the vertex " + std::to_string(index) +
               ", but there are " + std::to_string(count) + " vertices. Count them from 0.");
      }
      mesh.triangles[i][corner] = static_cast<std::int32_t>(index);
    }
  }
  return mesh;
}

std::unique_ptr<LabelVolume> VolumeOfArray::open() const {
  VolumeArray numbers;
  numbers.numbers = array.data();
  numbers.counts.assign(array.shape(), array.shape() + array.ndim());
  numbers.type = type;
  return open_array(numbers, choice, name);
}

VolumeOfArray volume_of(const py::object& argument, const std::string& name,
                        const std::array<double, 3>& voxel_size) {
  for (const double length : voxel_size) require_in_range(length, voxel_size_option);
  VolumeOfArray volume;
  volume.array = py::array::ensure(argument, py::array::c_style);
  const char kind = volume.array ? volume.array.dtype().kind() : ' ';
  if (std::string_view("iufb").find(kind) == std::string_view::npos) {
    throw py::type_error("The argument " + name +
                         " is no array of numbers. Give an array (nz, ny, nx).");
  }
  volume.name = name;
  volume.type = volume.array.dtype().attr("str").cast<std::string>();
  volume.choice.voxel_size = Vector3(voxel_size[0], voxel_size[1], voxel_size[2]);
  std::string shape;
  int dimensions = 0;
  for (py::ssize_t k = 0; k < volume.array.ndim(); ++k) {
    const py::ssize_t count = volume.array.shape(k);
    if (count == 0) refuse("The argument " + name + " has no voxels. Give an array (nz, ny, nx).");
    shape += (k == 0 ? "" : ", ") + std::to_string(count);
    dimensions += count > 1 ? 1 : 0;
  }
  if (dimensions > 3) {
    constexpr py::ssize_t most_channels = 8;
    const bool has_channels = volume.array.shape(volume.array.ndim() - 1) <= most_channels;
    refuse("The argument " + name + " has the shape (" + shape +
           "), but a volume has three dimensions. " + "Give one of them, such as " + name +
           (has_channels ? "[..., 0]." : "[0]."));
  }
  return volume;
}

std::string in_words_of_python(const Sentence& sentence) {
  return sentence.in([](const NamedOption& option) {
    std::string name = option.key;
    std::replace(name.begin(), name.end(), '-', '_');
    if (option.value.empty()) return name;
    if (option.value == "true") return name + "=True";
    const bool is_number = option.value.find_first_not_of("0123456789.-") == std::string::npos;
    return name + "=" + (is_number ? option.value : "\"" + option.value + "\"");
  });
}

void warn(const Sentence& sentence) {
  if (PyErr_WarnEx(PyExc_UserWarning, readable(in_words_of_python(sentence)).c_str(), 2) != 0) {
    throw py::error_already_set();
  }
}

py::object parsed(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

IndexedMesh mesh_of_reference(const py::object& reference) {
  try {
    const auto [vertices, faces] = reference.cast<std::pair<Points, py::object>>();
    return mesh_of(vertices, faces);
  } catch (const py::cast_error&) {
    throw py::type_error("The reference is of type " + type_name_of(reference) +
                         ". Give a pair of arrays, (vertices, faces).");
  }
}

bool goes_on(const py::object& answer) {
  if (answer.is_none()) return true;
  try {
    return answer.cast<bool>();
  } catch (const py::cast_error&) {
    throw py::type_error("The progress function returned a value of type " + type_name_of(answer) +
                         ". Return True, or False to cancel.");
  }
}

}  // namespace wscvt::python
