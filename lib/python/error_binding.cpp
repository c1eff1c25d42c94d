// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include <exception>
#include <new>

#include "bindings.h"
#include "conversion.h"
#include "wscvt/base/error.h"
#include "wscvt/base/readable_text.h"

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

}  // namespace

void bind_error(py::module_& module) {
  static py::handle error_type =
      py::register_exception<Error>(module, "Error", PyExc_RuntimeError).inc_ref();
  error_type.attr("__module__") = "wscvt";
  error_type.attr("__doc__") =
      "An error of the library. The message says what to do. `code` is invalid-input, "
      "not-star-shaped, numerical-failure, input-output or cancelled.";
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the signature that pybind11 asks for
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      py::object raised = error_type(readable(in_words_of_python(error.sentence())));
      raised.attr("code") = name_of(error.code());
      PyErr_SetObject(error_type.ptr(), raised.ptr());
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError,
                      "There is not enough memory for this. Simplify the mesh or use fewer "
                      "nodes.");
    }
  });
}

}  // namespace wscvt::python
