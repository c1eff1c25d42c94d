// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "parameters.h"

namespace wscvt::filter {

// The remesher with the few parameters that a person decides on, everything else at its default.
// Its values are read by read_remesh_settings.

/// The menu text. Saved scripts refer to it: it never changes.
std::string everyday_name();

std::string everyday_help();

/// Some of the remesher's parameters, at most ten, in the order in which a person decides.
ParameterList everyday_parameters();

/// The remesher's own list, in which all others are advanced.
ParameterList with_advanced_flags(ParameterList parameters);

}  // namespace wscvt::filter
