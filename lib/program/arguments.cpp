// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "help_text.h"
#include "remesh_arguments.h"
#include "wscvt/base/version.h"

namespace wscvt::program {

namespace {

constexpr NumberOption<int> threads_option = {
    "threads", "number of threads", 0, std::numeric_limits<int>::max(), Ends::Both, "0 for all"};

constexpr const char* footer =
    "A remesh of the same scan, options and version has the same bytes on any number of threads.\n"
    "What --json writes as an option is what one types here: \"weighting\": \"area\" is\n"
    "--weighting=area.\n"
    "Exit codes: 0 done; 1 the scan could not be remeshed or a file not be read or written;\n"
    "2 the arguments are wrong; 130 and 143 cancelled by SIGINT and SIGTERM. With 1 and 2 a "
    "sentence\n"
    "says what to do.";

}  // namespace

Arguments read_arguments(int argc, char** argv, int& exit_code) {
  Arguments arguments;
  CLI::App app{"Remesh a dense scan of a grain to exactly N nodes (WSCVT)."};
  app.get_formatter()->column_width(help_column);
  app.footer(footer);
  app.set_version_flag("--version", std::string("wscvt ") + version());
  app.add_option("input", arguments.input, "Scan: PLY, STL, OBJ or OFF")->required();
  app.add_option("output", arguments.output, "Remesh: PLY, STL, OBJ or OFF")->required();
  add_remesh_arguments(app, arguments.options);
  app.add_option_function<std::string>("-t,--threads",
                                       [&arguments](const std::string& text) {
                                         try {
                                           arguments.threads = from_typed(text, threads_option);
                                         } catch (const Error& error) {
                                           throw CLI::ValidationError("--threads", error.what());
                                         }
                                       })
      ->description(help_of(arguments.threads, threads_option))
      ->type_name("N");
  app.add_option("-j,--json", arguments.json, wrapped("Write the report to this file as JSON"))
      ->type_name("FILE");
  app.add_option("--report", arguments.reports,
                 wrapped("Write the report to this file, by its ending .html (a page with pictures "
                         "and histograms), .json, or .csv (a row more of a table); may be given "
                         "more than once"))
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--coefficients", arguments.coefficients,
                 wrapped("Write the fitted series to this file as JSON"))
      ->type_name("FILE");
  app.add_flag("--overwrite", arguments.overwrite, wrapped("Let an output replace the scan"));
  app.add_flag("-q,--quiet", arguments.quiet,
               wrapped("No report on the standard output, no progress; warnings stay"));
  exit_code = -1;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? Done : WrongArguments;
    if (exit_code == Done && !std::cout.flush()) {
      throw std::runtime_error("The help could not be written.");
    }
  }
  arguments.options.measures.coefficients = !arguments.coefficients.empty();
  return arguments;
}

}  // namespace wscvt::program
