// SPDX-License-Identifier: GPL-3.0-or-later
// The options of remesh and create as keywords.
#ifndef WSCVT_PYTHON_OPTION_ARGUMENTS_H_
#define WSCVT_PYTHON_OPTION_ARGUMENTS_H_

#include <pybind11/pybind11.h>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt::python {

/// Sets the options given by keyword, "edge_ratio" for "edge-ratio". Throws TypeError for unknown
/// names and values of another type, Error for values out of range.
RemeshOptions options_of(const pybind11::dict& given, RemeshOptions options);

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_OPTION_ARGUMENTS_H_
