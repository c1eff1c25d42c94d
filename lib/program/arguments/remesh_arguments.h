// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// Adds an argument for every option of both methods (is_option_of), under the option's key. Users
/// type options as reports print them. Parsing changes `options`, which must outlive `app`. Their
/// values before are the defaults of their method. A call with an option of the other method is
/// refused, with the option to use instead. Help texts are made from the options' tables and
/// ranges.
void add_remesh_arguments(CLI::App& app, RemeshOptions& options,
                          Remeshed remeshed = Remeshed::Scan);

}  // namespace wscvt::program
