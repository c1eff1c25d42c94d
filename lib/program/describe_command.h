// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>

#include "measure_arguments.h"

namespace wscvt::program {

/// `wscvt describe`: measures the shape of one grain.
struct DescribeArguments {
  MeasureArguments measure;
};

/// Adds the command to the program. Parsing changes `arguments`, which must outlive the program.
CLI::App& add_command(CLI::App& program, DescribeArguments& arguments);

/// Runs the command and returns the exit code. Throws wscvt::Error.
int run(const DescribeArguments& arguments);

}  // namespace wscvt::program
