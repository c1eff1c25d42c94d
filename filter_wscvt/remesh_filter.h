// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "node_parameters.h"
#include "parameters.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

/// The remesher's menu text. Saved scripts refer to it: it never changes.
std::string remesh_name();

/// What the filter does, when it refuses and whose method it is, as the HTML a host shows.
std::string remesh_help();

ParameterList remesh_parameters();

/// Everything the user chose.
struct RemeshSettings {
  RemeshOptions options;
  bool new_layer = true;
  bool keep_attributes = true;  ///< colour and quality of the scan
  ResultSettings result;
  std::string coefficients_file;  ///< to be written; empty: none
};

/// Throws Error(InvalidInput) for values that do not fit and file names with other extensions.
RemeshSettings read_remesh_settings(const ParameterValues& values);

}  // namespace wscvt::filter
