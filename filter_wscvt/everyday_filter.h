// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "parameters.h"

namespace wscvt::filter {

// The remesher with only the most important parameters. All others have their defaults.
// read_remesh_settings reads the values.

/// The menu text. Saved scripts refer to it: it never changes.
std::string everyday_name();

std::string everyday_help();

/// At most ten of the remesher's parameters, the most important first.
ParameterList everyday_parameters();

/// The remesher's own list, in which all others are advanced.
ParameterList with_advanced_flags(ParameterList parameters);

}  // namespace wscvt::filter
