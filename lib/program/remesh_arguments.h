// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// What is remeshed: some options mean nothing for a surface that is known exactly.
enum class Remeshed { Scan, Surface };

/// Gives `app` an argument for every option of both methods, under the option's key: what a report
/// prints as an option is what one types here. Reading a call changes `options`, which must outlive
/// `app`; their values before are the defaults of their method. An option of the other method, and
/// one of version 2, refuses the call with what to use instead. Help texts are made of the options'
/// tables and ranges.
void add_remesh_arguments(CLI::App& app, RemeshOptions& options,
                          Remeshed remeshed = Remeshed::Scan);

}  // namespace wscvt::program
