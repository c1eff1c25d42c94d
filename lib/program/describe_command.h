// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>

#include "measure_arguments.h"

namespace wscvt::program {

/// `wscvt describe`: the shape of one grain.
struct DescribeArguments {
  MeasureArguments measure;
};

/// Adds the command to the program. Reading a call changes `arguments`, which must outlive it.
CLI::App& add_command(CLI::App& program, DescribeArguments& arguments);

/// Does what the call says; gives the exit code. Throws wscvt::Error.
int run(const DescribeArguments& arguments);

}  // namespace wscvt::program
