// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include <exception>
#include <new>
#include <string>

#include "bindings.h"
#include "conversion.h"
#include "wscvt/base/error.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/text.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

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

/// Makes the subclass of wscvt.Error that is also one of Python's own errors.
py::handle error_subclass(py::module_& module, const char* name, py::handle base, py::handle own,
                          const char* text) {
  const std::string full = std::string("wscvt.") + name;
  const py::handle type =
      PyErr_NewExceptionWithDoc(full.c_str(), text, py::make_tuple(base, own).ptr(), nullptr);
  if (!type) throw py::error_already_set();
  module.attr(name) = type;
  return type;
}

/// The Python types of errors. They live as long as the interpreter.
struct ErrorTypes {
  py::handle error;
  py::handle input;
  py::handle file;
  py::handle missing;

  py::handle of(const Error& thrown) const {
    if (thrown.code() == ErrorCode::InvalidInput) return input;
    if (thrown.code() != ErrorCode::InputOutput) return error;
    const bool is_missing = dynamic_cast<const FileMissing*>(&thrown) != nullptr ||
                            dynamic_cast<const FolderMissing*>(&thrown) != nullptr;
    return is_missing ? missing : file;
  }
};

}  // namespace

void bind_error(py::module_& module) {
  static ErrorTypes types;
  types.error = py::register_exception<Error>(module, "Error", PyExc_RuntimeError).inc_ref();
  types.error.attr("__module__") = "wscvt";
  types.error.attr("__doc__") =
      "An error of the library. The message says what to do. `code` is invalid-input, "
      "not-star-shaped, numerical-failure, input-output or cancelled.";
  types.input = error_subclass(
      module, "InputError", types.error, PyExc_ValueError,
      "A mesh, the content of a file or an option is not usable. Also a ValueError.");
  // Those that Python raises itself have it too.
  types.input.attr("code") = name_of(ErrorCode::InvalidInput);
  types.file = error_subclass(module, "FileError", types.error, PyExc_OSError,
                              "A file could not be opened, read or written. Also an OSError.");
  types.missing =
      error_subclass(module, "MissingFileError", types.file, PyExc_FileNotFoundError,
                     "There is no file or folder of this name. Also a FileNotFoundError.");
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the signature that pybind11 asks for
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      const py::handle type = types.of(error);
      py::object raised = type(readable(in_words_of_python(error.sentence())));
      raised.attr("code") = name_of(error.code());
      PyErr_SetObject(type.ptr(), raised.ptr());
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError,
                      "There is not enough memory for this. Simplify the mesh or use fewer "
                      "nodes.");
    }
  });
}

}  // namespace wscvt::python
