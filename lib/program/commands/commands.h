// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <memory>

namespace wscvt::program {

/// A command of the program: its arguments, and what they start. `run` returns the exit code and
/// throws wscvt::Error.
struct Command {
  CLI::App* app;
  std::function<int()> run;
};

/// Adds a command to the program, and returns it. Its source has add_arguments(program, arguments),
/// which parsing changes, and run(arguments).
template <class Arguments>
Command make_command(CLI::App& program) {
  const auto arguments = std::make_shared<Arguments>();
  return {&add_arguments(program, *arguments), [arguments] { return run(*arguments); }};
}

// Each adds its command to the program, in the file of its name.
Command remesh_command(CLI::App& program);
Command describe_command(CLI::App& program);
Command create_command(CLI::App& program);
Command segment_command(CLI::App& program);
Command extract_command(CLI::App& program);
Command batch_command(CLI::App& program);
Command sample_command(CLI::App& program);
Command grow_command(CLI::App& program);
Command clump_command(CLI::App& program);
Command convex_command(CLI::App& program);
Command fragment_command(CLI::App& program);

}  // namespace wscvt::program
