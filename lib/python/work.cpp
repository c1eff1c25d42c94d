// SPDX-License-Identifier: GPL-3.0-or-later
#include "work.h"

#include <pybind11/pybind11.h>

#include "conversion.h"

namespace wscvt::python {

namespace py = pybind11;

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
