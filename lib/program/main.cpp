// SPDX-License-Identifier: GPL-3.0-or-later
// The command-line program: finds the command of a call and runs it.
#include <CLI/App.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/call/help_text.h"
#include "program/commands/commands.h"
#include "program/terminal/terminal.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/version.h"

namespace {

namespace program = wscvt::program;

int run(int argc, char** argv) {
  CLI::App app{"Remesh scanned grains to an exact number of nodes, and measure them.", "wscvt"};
  app.formatter(std::make_shared<program::HelpFormatter>(program::HelpFormatter::Extent::Brief,
                                                         program::help_width()));
  app.allow_windows_style_options(false);  // "/scans/sand.ply" is a file on Windows too
  app.footer(
      "\"wscvt SCAN OUTPUT\" means \"wscvt remesh SCAN OUTPUT\". \"wscvt FOLDER OUT\" and "
      "\"wscvt SCANS... OUT\" mean \"wscvt batch\". Help for a command:\n"
      "  wscvt help remesh\n"
      "  wscvt remesh --help-all\n" +
      program::exit_code_text(true));
  app.set_version_flag("-v,--version", std::string("wscvt ") + wscvt::version());
  app.require_subcommand(1);
  const std::vector<program::Command> commands = {
      program::remesh_command(app),  program::describe_command(app), program::create_command(app),
      program::segment_command(app), program::extract_command(app),  program::batch_command(app),
      program::sample_command(app),  program::grow_command(app),     program::clump_command(app),
      program::convex_command(app),  program::fragment_command(app),
  };
  const auto print_completion = [&app](std::int64_t) {
    throw CLI::CallForVersion(program::bash_completion(app), 0);  // printed like the version
  };
  app.add_flag_function("--completion", print_completion,
                        "Print a bash script that completes commands and options, and exit");
  app.add_option_function<std::string>(
         "--man-pages",
         [&app](const std::string& folder) {
           std::error_code ignored;  // the write reports it
           std::filesystem::create_directories(folder, ignored);
           for (const program::ManPage& page : program::man_pages(app)) {
             wscvt::write_file((std::filesystem::path(folder) / page.file).string(), page.text);
           }
           throw CLI::Success();
         },
         "Write a manual page per command into this folder, and exit")
      ->type_name("FOLDER");
  if (argc < 2) {
    wscvt::write_file("/dev/stdout", app.help());
    return program::WrongArguments;
  }
  try {
    std::vector<std::string> names;
    for (const program::Command& command : commands) names.push_back(command.app->get_name());
    program::CallWords call = program::call_words({argv + std::min(argc, 1), argv + argc}, names);
    std::reverse(call.words.begin(), call.words.end());  // order required by CLI11
    app.parse(call.words);
    if (!call.notice.empty()) {
      program::print_error(call.notice);
    }
  } catch (const CLI::ParseError& error) {
    std::ostringstream said;
    const int code = app.exit(error, std::cout, said);
    const std::string better = program::refusal_text(app, error);
    const std::string sentence = wscvt::readable(better.empty() ? said.str() : better + "\n");
    std::fputs(program::shown_on(program::Stream::Error, sentence).c_str(), stderr);
    if (code != 0) return program::WrongArguments;
    if (!std::cout.flush()) throw std::runtime_error("The help could not be written.");
    return program::Done;
  }
  for (const program::Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return program::WrongArguments;
}

}  // namespace

int main(int argc, char** argv) {
  const program::StandardStreams streams;
  program::ignore_file_size_signal();
  try {
    return run(argc, argv);
  } catch (const program::WrongCall& error) {
    program::print_error(error.what());
    return program::WrongArguments;
  } catch (const std::bad_alloc&) {
    program::print_error(
        "There is not enough memory for this call. Allow more memory (ulimit -v), simplify the "
        "mesh, or use fewer nodes.");
    return program::Failed;
  } catch (const std::exception& error) {
    program::print_error(error.what());
    // Exit code that a shell gives if the signal ends a program.
    const int signal = program::noted_signal();
    return signal == 0 ? program::Failed : 128 + signal;
  }
}
