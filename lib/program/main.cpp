// SPDX-License-Identifier: GPL-3.0-or-later
// The command-line program: finds the command of a call and runs it.
#include <CLI/App.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "batch_command.h"
#include "call_words.h"
#include "clump_command.h"
#include "command.h"
#include "completion.h"
#include "convex_command.h"
#include "create_command.h"
#include "describe_command.h"
#include "exit_code.h"
#include "extract_command.h"
#include "fragment_command.h"
#include "grow_command.h"
#include "man_pages.h"
#include "remesh_command.h"
#include "sample_command.h"
#include "segment_command.h"
#include "signals.h"
#include "standard_streams.h"
#include "wrong_call.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/version.h"

namespace {

namespace program = wscvt::program;

struct Command {
  CLI::App* app;
  std::function<int()> run;
};

template <class Arguments>
Command make_command(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  return {&program::add_command(app, *arguments), [arguments] { return run(*arguments); }};
}

int run(int argc, char** argv) {
  CLI::App app{"Remesh scanned grains to an exact number of nodes, and measure them.", "wscvt"};
  app.formatter(std::make_shared<program::HelpFormatter>());
  app.allow_windows_style_options(false);  // "/scans/sand.ply" is a file on Windows too
  app.footer(
      "\"wscvt SCAN OUTPUT\" means \"wscvt remesh SCAN OUTPUT\". \"wscvt FOLDER OUT\" and "
      "\"wscvt SCANS... OUT\"\nmean \"wscvt batch\". Help for a command:\n"
      "  wscvt help remesh\n"
      "  wscvt remesh --help-all\n" +
      program::exit_code_text(true));
  app.set_version_flag("-v,--version", std::string("wscvt ") + wscvt::version());
  app.require_subcommand(1);
  const std::vector<Command> commands = {
      make_command<program::RemeshArguments>(app),   make_command<program::DescribeArguments>(app),
      make_command<program::CreateArguments>(app),   make_command<program::SegmentArguments>(app),
      make_command<program::ExtractArguments>(app),  make_command<program::BatchArguments>(app),
      make_command<program::SampleArguments>(app),   make_command<program::GrowArguments>(app),
      make_command<program::ClumpArguments>(app),    make_command<program::ConvexArguments>(app),
      make_command<program::FragmentArguments>(app),
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
    for (const Command& command : commands) names.push_back(command.app->get_name());
    program::CallWords call = program::call_words({argv + std::min(argc, 1), argv + argc}, names);
    std::reverse(call.words.begin(), call.words.end());  // order required by CLI11
    app.parse(call.words);
    if (!call.notice.empty()) {
      std::fputs((wscvt::readable(call.notice) + "\n").c_str(), stderr);
    }
  } catch (const CLI::ParseError& error) {
    std::ostringstream said;
    const int code = app.exit(error, std::cout, said);
    const std::string better = program::refusal_text(app, error);
    std::fputs(wscvt::readable(better.empty() ? said.str() : better + "\n").c_str(), stderr);
    if (code != 0) return program::WrongArguments;
    if (!std::cout.flush()) throw std::runtime_error("The help could not be written.");
    return program::Done;
  }
  for (const Command& command : commands) {
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
    std::fprintf(stderr, "%s\n", wscvt::readable(error.what()).c_str());
    return program::WrongArguments;
  } catch (const std::bad_alloc&) {
    std::fputs(
        "There is not enough memory for this call. Allow more memory (ulimit -v), simplify the "
        "mesh, or use fewer nodes.\n",
        stderr);
    return program::Failed;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", wscvt::readable(error.what()).c_str());
    // Exit code that a shell gives if the signal ends a program.
    const int signal = program::noted_signal();
    return signal == 0 ? program::Failed : 128 + signal;
  }
}
