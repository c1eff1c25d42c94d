// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "common_arguments.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/surface/grain_surface.h"

namespace wscvt::program {

/// `wscvt create`: makes a mesh of a surface that is known exactly.
struct CreateArguments {
  CreateArguments();

  GrainSurface surface;
  std::string output;
  CommonArguments common;
  RemeshOptions options;  ///< by default, nodes on the surface
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, CreateArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const CreateArguments& arguments);

}  // namespace wscvt::program
