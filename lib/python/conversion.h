// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes, lists and reports between NumPy and the library.
#ifndef WSCVT_PYTHON_CONVERSION_H_
#define WSCVT_PYTHON_CONVERSION_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "toolbox/clump/clump_options.h"
#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/error.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/base/text.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::python {

/// An array of doubles. Arguments of this type accept anything that NumPy converts.
using Points = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Returns the name of a value's type, for messages.
std::string type_name_of(const pybind11::handle& value);

/// Returns the points of an array (n, 3). Throws Error for another shape.
std::vector<Vector3> points_of(const Points& vertices);

/// Returns a mesh of vertices (n, 3) and faces (m, 3). The faces may be None, for points only.
/// Throws Error for other shapes and for indices outside of 0 to n - 1, TypeError for faces that
/// are not whole numbers.
IndexedMesh mesh_of(const Points& vertices, const pybind11::object& faces);

/// Returns the mesh of a pair (vertices, faces). Throws TypeError for other types.
IndexedMesh mesh_of_reference(const pybind11::object& reference);

/// Returns an array (n,) of numbers, or (n, width) of rows of numbers, such as points and
/// triangles.
template <class Row>
auto array_of(const std::vector<Row>& rows) {
  const auto count = static_cast<pybind11::ssize_t>(rows.size());
  if constexpr (std::is_arithmetic_v<Row>) {
    return pybind11::array_t<Row>(count, rows.data());
  } else {
    using Number = std::decay_t<decltype(*std::declval<Row>().data())>;
    const pybind11::ssize_t width = std::size(Row());
    pybind11::array_t<Number> array({count, width});
    Number* next = array.mutable_data();
    for (const Row& row : rows) next = std::copy(row.begin(), row.end(), next);
    return array;
  }
}

/// Returns an array with a number or a row for each item: its member, or what `get` returns of it.
template <class Item, class Get>
auto column(const std::vector<Item>& items, const Get& get) {
  using Value = std::decay_t<std::invoke_result_t<const Get&, const Item&>>;
  if constexpr (std::is_arithmetic_v<Value>) {
    pybind11::array_t<Value> values(static_cast<pybind11::ssize_t>(items.size()));
    Value* next = values.mutable_data();
    for (const Item& item : items) *next++ = std::invoke(get, item);
    return values;
  } else {
    std::vector<Value> rows;
    for (const Item& item : items) rows.push_back(std::invoke(get, item));
    return array_of(rows);
  }
}

/// Returns the value of a name in upper or lower case, like the program: the paper's WSCVT-D is the
/// key wscvt-d. Throws Error for other texts.
template <class Enumeration>
Enumeration value_of_name(const std::string& name) {
  return from_key<Enumeration>(lower_case(name));
}

/// A volume in an array, which it keeps.
struct VolumeOfArray {
  pybind11::array array;  ///< contiguous, the last dimension fastest
  std::string type;       ///< NumPy's name of its numbers
  std::string name;       ///< of the argument
  VolumeChoice choice;

  /// Opens it as the program opens a .npy file of it.
  std::unique_ptr<LabelVolume> open() const;
};

/// Returns the volume of an argument (nz, ny, nx); dimensions of one are left out. Throws TypeError
/// for anything but numbers, Error for other shapes and for voxel sizes that are not above 0.
VolumeOfArray volume_of(const pybind11::object& argument, const std::string& name,
                        const std::array<double, 3>& voxel_size);

/// Returns what `work` returns of an array. No file is wrong: Error(InputOutput) becomes
/// InvalidInput.
template <class Work>
auto of_array(const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::InputOutput) throw;
    refuse(error.sentence());
  }
}

/// What to do with a volume's file, where a mesh or a table is needed.
inline constexpr const char* ways_of_volumes =
    "wscvt.batch(FILE, output=FOLDER) remeshes and measures its labels, and wscvt.sample(FOLDER) "
    "then has their statistics. wscvt.extract(ARRAY) returns a mesh of each label of an array, and "
    "wscvt.segment(ARRAY) makes labels of grey values.";

/// Replaces command-line options in a sentence of the library by argument names: "--edge-ratio"
/// becomes "edge_ratio". Sentences that show a command stay unchanged.
std::string in_words_of_python(const Sentence& sentence);

/// Issues a sentence as a UserWarning. Throws if Python's warning filters turn it into an
/// exception.
void warn(const Sentence& sentence);

/// Converts JSON to dictionaries, lists and numbers.
pybind11::object parsed(const std::string& json);

/// Sets the options of the remesh of a function ("remesh", "create", "convex", "batch") that are
/// given by keyword, "edge_ratio" for "edge-ratio". The others have the defaults of the program's
/// command of this name. Throws TypeError for names that this command does not have and for values
/// of another type, Error for values out of range.
RemeshOptions options_of(const pybind11::dict& given, const std::string& function);

/// Returns the options of clump; as options_of.
ClumpOptions clump_options_of(const pybind11::dict& given);

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_CONVERSION_H_
