// SPDX-License-Identifier: GPL-3.0-or-later
// The library for Python: meshes are NumPy arrays, options are keywords under the names that one
// types for the program, reports are dictionaries.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/readable_text.h"
#include "wscvt/base/version.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/option_advice.h"
#include "wscvt/report/report.h"
#include "wscvt/scan/mesh_io.h"
#include "wscvt/surface/grain_surface.h"

namespace py = pybind11;

namespace {

using wscvt::Error;
using wscvt::ErrorCode;
using wscvt::IndexedMesh;
using wscvt::refuse;
using wscvt::Vector3;
using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidInput:
      return "invalid-input";
    case ErrorCode::NotStarShaped:
      return "not-star-shaped";
    case ErrorCode::NumericalFailure:
      return "numerical-failure";
    case ErrorCode::InputOutput:
      return "input-output";
    case ErrorCode::Cancelled:
      break;
  }
  return "cancelled";
}

// Options.

/// "target_measure" of "target-measure".
std::string keyword_of(std::string_view key) {
  std::string keyword(key);
  std::replace(keyword.begin(), keyword.end(), '-', '_');
  return keyword;
}

std::string type_name_of(const py::handle& value) {
  return py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>();
}

template <class Value>
Value cast_option(const std::string& keyword, const py::handle& value, const char* wanted) {
  try {
    return value.cast<Value>();
  } catch (const py::cast_error&) {
    throw py::type_error("The option " + keyword + " is " + py::repr(value).cast<std::string>() +
                         "; give " + wanted + ".");
  }
}

/// Takes the options that are given.
class ReadOptions {
 public:
  explicit ReadOptions(const py::dict& given) : given_(given) {}

  template <class Number>
  void operator()(Number& value, const wscvt::NumberOption<Number>& option) {
    constexpr bool is_whole = std::is_integral_v<Number>;
    read(option.key, [&](const std::string& keyword, const py::handle& object) {
      value = cast_option<Number>(
          keyword, object,
          (std::string(is_whole ? "a whole number " : "a number ") + range_text(option)).c_str());
      require_in_range(value, option);
    });
  }
  void operator()(bool& value, const wscvt::FlagOption& option) {
    read(option.key, [&](const std::string& keyword, const py::handle& object) {
      value = cast_option<bool>(keyword, object, "True or False");
    });
  }
  template <class Enumeration>
  void operator()(Enumeration& value) {
    read(wscvt::EnumerationTable<Enumeration>::key,
         [&](const std::string& keyword, const py::handle& object) {
           const auto key =
               cast_option<std::string>(keyword, object, wscvt::keys_of<Enumeration>().c_str());
           const std::string advice =
               wscvt::advice_for_value(wscvt::EnumerationTable<Enumeration>::key, key, method_);
           if (!advice.empty()) refuse("The option " + keyword + ": " + advice);
           value = wscvt::from_key<Enumeration>(key);
           if constexpr (std::is_same_v<Enumeration, wscvt::Method>) method_ = value;
         });
  }

  /// Throws TypeError for what is no option.
  void finish() const {
    if (found_ == given_.size()) return;
    for (const auto& [name, value] : given_) {
      const auto keyword = name.cast<std::string>();
      if (std::find(known_.begin(), known_.end(), keyword) != known_.end()) continue;
      std::string key = keyword;
      std::replace(key.begin(), key.end(), '_', '-');
      const std::string advice = wscvt::advice_for_option(key, method_);
      if (!advice.empty()) throw py::type_error("The option " + keyword + ": " + advice);
      throw py::type_error("There is no option " + keyword +
                           "; wscvt.options() has the options and their defaults.");
    }
  }

 private:
  template <class Read>
  void read(std::string_view key, const Read& read) {
    known_.push_back(keyword_of(key));
    const std::string& keyword = known_.back();
    if (!given_.contains(keyword.c_str())) return;
    ++found_;
    read(keyword, given_[keyword.c_str()]);
  }

  const py::dict& given_;
  std::vector<std::string> known_;
  std::size_t found_ = 0;
  wscvt::Method method_ = wscvt::Method::OnScan;
};

wscvt::RemeshOptions options_of(const py::dict& given, wscvt::RemeshOptions options) {
  ReadOptions read(given);
  for_each_option(options, read);
  read.finish();
  return options;
}

class OptionsToDict {
 public:
  template <class Number>
  void operator()(const Number& value, const wscvt::NumberOption<Number>& option) {
    options_[keyword_of(option.key).c_str()] = value;
  }
  void operator()(const bool& value, const wscvt::FlagOption& option) {
    options_[keyword_of(option.key).c_str()] = value;
  }
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    options_[keyword_of(wscvt::EnumerationTable<Enumeration>::key).c_str()] = key_of(value);
  }
  py::dict options_;
};

/// The names that the values of an option have, by the option.
class ChoicesToDict {
 public:
  template <class Number>
  void operator()(const Number&, const wscvt::NumberOption<Number>&) {}
  void operator()(const bool&, const wscvt::FlagOption&) {}
  template <class Enumeration>
  void operator()(const Enumeration&) {
    py::list names;
    const std::string keyword = keyword_of(wscvt::EnumerationTable<Enumeration>::key);
    // Both methods may have the option, each with its own values.
    if (choices_.contains(keyword.c_str())) names = choices_[keyword.c_str()];
    for (const auto& row : wscvt::enumerators<Enumeration>()) {
      if (!names.contains(std::string(row.key))) names.append(std::string(row.key));
    }
    choices_[keyword.c_str()] = names;
  }
  py::dict choices_;
};

// Meshes.

std::vector<Vector3> points_of(const Points& vertices) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3) {
    refuse("The vertices have another shape than (n, 3); give x, y and z in a row a vertex.");
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
  // Numbers with decimals would be cut without a word.
  if (!array || (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')) {
    throw py::type_error(
        "The faces are no whole numbers; give the indices of three vertices a row.");
  }
  if (array.ndim() != 2 || array.shape(1) != 3) {
    refuse(
        "The faces have another shape than (n, 3); give three indices in a row a triangle. Those "
        "of PyVista are mesh.regular_faces of a triangulated mesh.");
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
               ", but there are " + std::to_string(count) + "; count them from 0.");
      }
      mesh.triangles[i][corner] = static_cast<std::int32_t>(index);
    }
  }
  return mesh;
}

py::array_t<double> array_of(const std::vector<Vector3>& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  auto rows = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) rows(static_cast<py::ssize_t>(i), k) = points[i][k];
  }
  return array;
}

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<std::int32_t> array_of(const std::vector<wscvt::Triangle>& triangles) {
  py::array_t<std::int32_t> array({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}});
  auto rows = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      rows(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) = triangles[i][k];
    }
  }
  return array;
}

py::object parsed(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

/// What remesh and create return; see the stub for what it holds.
struct Remesh {
  wscvt::RemeshResult result;
  wscvt::ReportOrigin origin;
};

/// The mesh to compare with. Throws TypeError for what is no pair of arrays.
IndexedMesh mesh_of_reference(const py::object& reference) {
  try {
    const auto [vertices, faces] = reference.cast<std::pair<Points, py::object>>();
    return mesh_of(vertices, faces);
  } catch (const py::cast_error&) {
    throw py::type_error("The reference is of type " + type_name_of(reference) +
                         "; give a pair of arrays, (vertices, faces).");
  }
}

// Work.

/// Whether the work goes on. Throws TypeError for what is no answer.
bool goes_on(const py::object& answer) {
  if (answer.is_none()) return true;
  try {
    return answer.cast<bool>();
  } catch (const py::cast_error&) {
    throw py::type_error("The function for the progress returned a value of type " +
                         type_name_of(answer) + "; return True, or False to cancel.");
  }
}

/// Does work without the interpreter's lock. What a progress callback throws cancels it and goes on
/// to the caller, and so does Ctrl-C.
template <class Work>
auto work_on(int threads, const py::object& progress, const Work& work) {
  std::exception_ptr thrown;
  const auto callback = [&](double fraction, const std::string& stage) {
    const py::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (progress.is_none()) return true;
      return goes_on(progress(fraction, stage));
    } catch (...) {
      thrown = std::current_exception();
      return false;
    }
  };
  try {
    const wscvt::Execution execution(threads, callback);
    const py::gil_scoped_release unlocked;
    return work(execution);
  } catch (const Error&) {
    if (thrown) std::rethrow_exception(thrown);
    throw;
  }
}

Remesh remesh(const Points& vertices, const py::object& faces, int threads,
              const py::object& progress, const std::string& source, const py::kwargs& given) {
  const wscvt::RemeshOptions options = options_of(given, {});
  IndexedMesh scan = mesh_of(vertices, faces);
  return {work_on(threads, progress,
                  [&](const wscvt::Execution& execution) {
                    return wscvt::remesh(std::move(scan), options, execution);
                  }),
          {source, ""}};
}

Remesh create(const std::string& kind, const std::array<double, 3>& semi_axes,
              double polar_exponent, double azimuthal_exponent,
              const std::string& coefficients_file, int coefficient_degree, int threads,
              const py::object& progress, const py::kwargs& given) {
  wscvt::GrainSurface surface;
  surface.kind = wscvt::from_key<wscvt::SurfaceKind>(kind);
  surface.semi_axes = Vector3(semi_axes[0], semi_axes[1], semi_axes[2]);
  surface.polar_exponent = polar_exponent;
  surface.azimuthal_exponent = azimuthal_exponent;
  surface.coefficients_file = coefficients_file;
  surface.coefficient_degree = coefficient_degree;
  wscvt::RemeshOptions defaults;
  wscvt::OnScanOptions on_surface;
  on_surface.placement = wscvt::ScanPlacement::OnSurface;
  defaults.method = on_surface;
  const wscvt::RemeshOptions options = options_of(given, defaults);
  return {work_on(threads, progress,
                  [&](const wscvt::Execution& execution) {
                    return wscvt::remesh(surface, options, execution);
                  }),
          {surface_name(surface), ""}};
}

py::object describe(const Points& vertices, const py::object& faces, const py::object& reference,
                    double roundness_ball, double roughness_cutoff, int threads,
                    const py::object& progress) {
  wscvt::DetailedOptions options;
  options.roundness_ball = roundness_ball;
  options.roughness_cutoff = roughness_cutoff;
  wscvt::NamedMesh grain = {"grain", mesh_of(vertices, faces)};
  std::optional<wscvt::NamedMesh> original;
  if (!reference.is_none()) {
    original = wscvt::NamedMesh{"reference", mesh_of_reference(reference)};
  }
  const wscvt::GrainMeasures measures =
      work_on(threads, progress, [&](const wscvt::Execution& execution) {
        return measure_grain(std::move(grain), std::move(original), options, execution);
      });
  return parsed(descriptor_json(measures));
}

/// The mesh of a file, whose warnings become Python's.
IndexedMesh warned(wscvt::MeshFile file) {
  for (const std::string& warning : file.warnings) {
    if (PyErr_WarnEx(PyExc_UserWarning, wscvt::readable(warning).c_str(), 1) != 0) {
      throw py::error_already_set();
    }
  }
  return std::move(file.mesh);
}

// What the module holds.

void define_error(py::module_& module) {
  static py::handle error_type =
      py::register_exception<Error>(module, "Error", PyExc_RuntimeError).inc_ref();
  error_type.attr("__module__") = "wscvt";
  error_type.attr("__doc__") =
      "What the library refuses or could not do, in a sentence that says what to do. `code` is "
      "invalid-input, not-star-shaped, numerical-failure, input-output or cancelled.";
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the signature that pybind11 asks for
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      py::object raised = error_type(wscvt::readable(error.what()));
      raised.attr("code") = name_of(error.code());
      PyErr_SetObject(error_type.ptr(), raised.ptr());
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError,
                      "There is not enough memory for this; simplify the mesh or ask for fewer "
                      "nodes.");
    }
  });
}

void define_remesh_class(py::module_& module) {
  py::class_<Remesh> remesh_class(
      module, "Remesh",
      "A remesh of N nodes: vertices (N, 3) float64 and faces (m, 3) int32, m = 2 N - 4 without "
      "handles, "
      "counter-clockwise "
      "from outside; centre (3,); radial_distances (N,) from it, length; cell_areas (N,), "
      "length^2; "
      "vertex_distances (N,) to the scan, length, empty unless distances=True; warnings, a list of "
      "sentences; report, a dictionary as the JSON report. str() gives the log.");
  remesh_class.attr("__module__") = "wscvt";
  remesh_class
      .def_property_readonly("vertices",
                             [](const Remesh& one) { return array_of(one.result.mesh.points); })
      .def_property_readonly("faces",
                             [](const Remesh& one) { return array_of(one.result.mesh.triangles); })
      .def_property_readonly("centre",
                             [](const Remesh& one) {
                               const Vector3& c = one.result.centre;
                               return array_of(std::vector<double>{c.x(), c.y(), c.z()});
                             })
      .def_property_readonly(
          "radial_distances",
          [](const Remesh& one) { return array_of(one.result.radial_distances); })
      .def_property_readonly("cell_areas",
                             [](const Remesh& one) { return array_of(one.result.cell_areas); })
      .def_property_readonly(
          "vertex_distances",
          [](const Remesh& one) { return array_of(one.result.vertex_distances); })
      .def_property_readonly("warnings", [](const Remesh& one) { return one.result.warnings; })
      .def_property_readonly(
          "report", [](const Remesh& one) { return parsed(report_json(one.result, one.origin)); })
      .def("__repr__",
           [](const Remesh& one) {
             return "<wscvt.Remesh of " + std::to_string(one.result.mesh.points.size()) +
                    " nodes and " + std::to_string(one.result.mesh.triangles.size()) + " faces, " +
                    std::to_string(one.result.warnings.size()) + " warnings>";
           })
      .def("__str__", [](const Remesh& one) {
        std::string text;
        for (const std::string& line : report_lines(one.result)) text += line + "\n";
        return text;
      });
}

void define_options(py::module_& module) {
  module.def(
      "options",
      [](const std::string& method) {
        OptionsToDict dict;
        wscvt::RemeshOptions defaults;
        if (wscvt::from_key<wscvt::Method>(method) == wscvt::Method::AsPublished) {
          defaults.method = wscvt::AsPublishedOptions();
        }
        for_each_option(defaults, dict);
        return dict.options_;
      },
      py::arg("method") = key_of(wscvt::Method::OnScan),
      "All options of remesh and create by a method, with their defaults: the names that one types "
      "for the program, with _ for -.");
  module.def("_choices", [] {
    ChoicesToDict dict;
    const wscvt::RemeshOptions options;
    for_each_option(options, dict);
    const wscvt::AsPublishedOptions published;
    for_each_method_option(published, dict);
    return dict.choices_;
  });
}

void define_work(py::module_& module) {
  module.def(
      "remesh", &remesh, py::arg("vertices"), py::arg("faces"), py::kw_only(),
      py::arg("threads") = 0, py::arg("progress") = py::none(), py::arg("source") = "",
      "Remeshes a dense scan to exactly N nodes. vertices: (n, 3) float64, any unit of length; "
      "faces: (m, 3) whole numbers counted from 0, or None for points with points=True. A path, or "
      "a "
      "mesh of trimesh or PyVista, takes the place of both: remesh('scan.ply', 500). "
      "Options by name: see options(). threads: 0 takes all; they change no result. "
      "progress(fraction, stage) is called in between; False, or an exception, cancels. "
      "source: what the report names as the scan. Raises Error, and TypeError for options "
      "that there are not.");
  module.def(
      "create", &create, py::arg("surface"), py::kw_only(),
      py::arg("semi_axes") = std::array<double, 3>{1.0, 1.0, 1.0}, py::arg("polar_exponent") = 1.0,
      py::arg("azimuthal_exponent") = 1.0, py::arg("coefficients_file") = "",
      py::arg("coefficient_degree") = -1, py::arg("threads") = 0, py::arg("progress") = py::none(),
      "A mesh of N nodes of a surface that is known exactly: ellipsoid, superellipsoid, or "
      "harmonics from coefficients_file (.dat, .sh or .json). semi_axes: three lengths. Nodes lie "
      "on the surface unless placement says otherwise. The rest as remesh.");
  module.def(
      "describe", &describe, py::arg("vertices"), py::arg("faces"),
      py::arg("reference") = py::none(), py::kw_only(),
      py::arg("roundness_ball") = wscvt::DetailedOptions().roundness_ball,
      py::arg("roughness_cutoff") = wscvt::DetailedOptions().roughness_cutoff,
      py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Size, form, roundness, roughness and orientation of a closed mesh, as the dictionary "
      "of a JSON report; with reference=(vertices, faces) errors and distances against that. "
      "Arrays as for remesh; lengths in the unit of the mesh.");
}

void define_files(py::module_& module) {
  module.def(
      "read_mesh",
      [](const std::string& path) {
        const IndexedMesh mesh = warned(wscvt::read_mesh_file(path));
        return std::make_pair(array_of(mesh.points), array_of(mesh.triangles));
      },
      py::arg("path"),
      ("Vertices (n, 3) float64 and faces (m, 3) int32 of a file that ends in " +
       wscvt::mesh_extensions(wscvt::MeshUse::Read) +
       ", also packed by gzip, as they are: nothing is repaired, and of STL each corner is a "
       "vertex. Of the last three there are no faces. What is odd about a file is a UserWarning.")
          .c_str());
  module.def(
      "write_mesh",
      [](const std::string& path, const Points& vertices, const py::object& faces) {
        wscvt::write_mesh(mesh_of(vertices, faces), path);
      },
      py::arg("path"), py::arg("vertices"), py::arg("faces"),
      ("Writes a file by its ending, " + wscvt::mesh_extensions(wscvt::MeshUse::Write) +
       ", whole or not at all.")
          .c_str());
}

}  // namespace

PYBIND11_MODULE(_wscvt, module) {
  module.attr("__version__") = wscvt::version();
  define_error(module);
  define_remesh_class(module);
  define_options(module);
  define_work(module);
  define_files(module);
}
