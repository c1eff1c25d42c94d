// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "node_parameters.h"
#include "parameters.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/grain_surface.h"

namespace wscvt::filter {

/// The menu text. Saved scripts refer to it: it never changes.
std::string creation_name();

std::string creation_help();

ParameterList creation_parameters();

struct CreationSettings {
  GrainSurface surface;
  RemeshOptions options;
  ResultSettings result;
};

/// Throws Error(InvalidInput) for values that do not fit and file names with other extensions.
CreationSettings read_creation_settings(const ParameterValues& values);

}  // namespace wscvt::filter
