// SPDX-License-Identifier: GPL-3.0-or-later
// The options of functions as keywords.
#ifndef WSCVT_PYTHON_OPTION_ARGUMENTS_H_
#define WSCVT_PYTHON_OPTION_ARGUMENTS_H_

#include <pybind11/pybind11.h>

#include <string>

#include "toolbox/clump/clump_options.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::python {

/// Sets the options of the remesh of a function ("remesh", "create", "convex", "batch") that are
/// given by keyword, "edge_ratio" for "edge-ratio". The others have the defaults of the program's
/// command of this name. Throws TypeError for names that this command does not have and for values
/// of another type, Error for values out of range.
RemeshOptions options_of(const pybind11::dict& given, const std::string& function);

/// Returns the options of clump; as options_of.
ClumpOptions clump_options_of(const pybind11::dict& given);

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_OPTION_ARGUMENTS_H_
