// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "batch_command.h"

namespace wscvt::program {

/// `wscvt extract`: the grains of a volume of labels become meshes, dense or remeshed.
struct ExtractArguments {
  std::string volume;
  bool remesh = false;
  BatchArguments
      sample;  ///< folder, format, threads, what is asked of the volume; for remeshes all
};

/// Adds the command to the program. Reading a call changes `arguments`, which must outlive it.
CLI::App& add_command(CLI::App& program, ExtractArguments& arguments);

/// Does what the call says; gives the exit code. Throws wscvt::Error.
int run(const ExtractArguments& arguments);

}  // namespace wscvt::program
