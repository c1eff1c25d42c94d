// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes, lists and reports between NumPy and the library.
#ifndef WSCVT_PYTHON_CONVERSION_H_
#define WSCVT_PYTHON_CONVERSION_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/lower_case.h"
#include "wscvt/base/option.h"

namespace wscvt::python {

/// An array of decimal numbers; an argument of this type takes whatever NumPy makes one of.
using Points = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// The name of a value's type, for messages.
std::string type_name_of(const pybind11::handle& value);

/// Points of an array (n, 3). Throws Error for another shape.
std::vector<Vector3> points_of(const Points& vertices);

/// A mesh of vertices (n, 3) and faces (m, 3), which may be None for points alone. Throws Error for
/// other shapes and for indices outside of 0 to n - 1, TypeError for faces that are no whole
/// numbers.
IndexedMesh mesh_of(const Points& vertices, const pybind11::object& faces);

/// The mesh of a pair (vertices, faces). Throws TypeError for what is no pair of arrays.
IndexedMesh mesh_of_reference(const pybind11::object& reference);

/// Arrays (n, 3), (n,) and (m, 3).
pybind11::array_t<double> array_of(const std::vector<Vector3>& points);
pybind11::array_t<double> array_of(const std::vector<double>& values);
pybind11::array_t<std::int32_t> array_of(const std::vector<Triangle>& triangles);

/// The value of a name in letters of any size, as the program takes it: the paper's WSCVT-D is the
/// key wscvt-d. Throws Error for any other text.
template <class Enumeration>
Enumeration value_of_name(const std::string& name) {
  return from_key<Enumeration>(lower_case(name));
}

/// A sentence of the library, which names options as the program has them, with the names of
/// arguments: "edge_ratio" for "--edge-ratio". Sentences that show a command stay as they are.
std::string in_words_of_python(const std::string& sentence);

/// Gives a sentence as Python's UserWarning. Throws what a filter of warnings makes of it.
void warn(const std::string& sentence);

/// The dictionaries, lists and numbers of a text in JSON.
pybind11::object parsed(const std::string& json);

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_CONVERSION_H_
