// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/output_paths.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "toolbox/report/sample_report.h"
#include "toolbox/sample/detail_levels.h"
#include "toolbox/sample/grain_sample.h"
#include "toolbox/sample/sample_files.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

namespace {

/// `wscvt sample`: computes the statistics of a sample, or compares two samples.
struct SampleArguments {
  std::vector<std::string> samples;  ///< folders of a batch, or tables; one or two
  SampleOptions options;
  std::vector<double> densities;  ///< one for all samples, or one per sample; may be empty
  double mark_percent = usual_mark_percent;  ///< of levels
  std::vector<std::string> reports;          ///< files; the ending selects the format
  int threads = 0;                           ///< 0: all
  bool quiet = false;
  bool verbose = false;
};

namespace fs = std::filesystem;

constexpr NumberOption<int> seed_option = {
    "seed",     "seed",
    0,          2147483647,
    Ends::Both, "of the random numbers for intervals and p; the same seed gives the same bytes"};

/// Reads "2650", or "2650,2600".
std::vector<double> densities_of(std::string_view text) {
  std::vector<double> densities;
  while (true) {
    const std::size_t comma = text.find(',');
    densities.push_back(from_typed(text.substr(0, comma), density_option));
    if (comma == std::string_view::npos) return densities;
    text.remove_prefix(comma + 1);
  }
}

void check_densities(const SampleArguments& arguments) {
  const std::size_t given = arguments.densities.size();
  if (given > 1 && given != arguments.samples.size()) {
    refuse(std::to_string(given) + " densities are given, and " +
           format_count(arguments.samples.size(), "sample") +
           ". Give one density, or one per sample.");
  }
}

std::string name_of(const std::string& path) {
  fs::path whole(path);
  if (whole.filename().empty()) whole = whole.parent_path();
  if (whole.filename() == "shape.csv" && whole.has_parent_path()) whole = whole.parent_path();
  const std::string name = whole.filename().string();
  return name == "." || name == ".." || name.empty() ? path : name;
}

CLI::App& add_arguments(CLI::App& program, SampleArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"sample",
       "Compute the statistics of a sample, or compare two samples",
       {"out --report sample.html", "out supplier.csv --report both.html --diameter feret-min",
        "out --density 2650 --report sample.csv --report sample.json"},
       "SAMPLE is an output folder of wscvt batch, or a table with a column \"grain\" and columns "
       "of numbers, named as in shape.csv. The folder of a batch with several numbers of nodes "
       "(-n 100,300) also gives the errors against the number of nodes."});
  app.add_option("samples", arguments.samples,
                 "A folder or a table; a second sample is compared with the first")
      ->type_name("SAMPLE")
      ->required();
  add_choice(app, arguments.options.size);
  add_choice(app, arguments.options.of);
  add_typed(app, "--density",
            [&arguments](std::string_view text) { arguments.densities = densities_of(text); })
      ->description(
          "Mass / volume, in the units of the table. For two samples, one value for both or two "
          "values such as 2650,2600. Default: the table's column mass or density, else 1")
      ->type_name("N");
  add_number(app, "--max-error", arguments.mark_percent, mark_option);
  add_typed(app, "--seed",
            [&arguments](std::string_view text) {
              arguments.options.seed = static_cast<std::uint64_t>(from_typed(text, seed_option));
            })
      ->description(help_of(static_cast<int>(arguments.options.seed), seed_option))
      ->type_name("N");
  app.add_option("--report", arguments.reports,
                 "Write the report to this file: .html (a page), .json or .csv (all statistics). "
                 "May be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_threads_argument(app, arguments.threads);
  app.add_flag("-q,--quiet", arguments.quiet, "Print only errors");
  add_verbose_argument(app, arguments.verbose);
  return app;
}

int run(const SampleArguments& arguments) {
  checked([&] {
    if (arguments.samples.size() > 2) {
      refuse(std::to_string(arguments.samples.size()) +
             " samples are given. Give one sample, or two to compare.");
    }
    check_densities(arguments);
    for (const std::string& report : arguments.reports) report_format(report);
    std::vector<NamedFile> inputs;
    for (const std::string& path : arguments.samples) {
      refuse_volume_input(path, ways_of_volumes);
      if (!fs::is_directory(path)) inputs.push_back({"a table", path});
    }
    check_output_paths(inputs, named_reports(arguments.reports));
  });
  Work work(arguments.threads, arguments.quiet);
  const Execution& execution = work.execution();
  SampleReport report;
  report.options = arguments.options;
  for (const std::string& path : arguments.samples) {
    add_sample(report, name_of(path), read_sample(path, execution), arguments.densities,
               arguments.mark_percent, execution);
  }
  if (report.samples.size() > 1 && report.samples[0].name == report.samples[1].name) {
    for (std::size_t k = 0; k < 2; ++k) report.samples[k].name = arguments.samples[k];
  }
  compare_samples(report, execution);
  for (const std::string& file : arguments.reports) {
    work.write(file, [&] { write_sample_report(file, report, work.writing()); });
  }
  work.print({}, arguments.verbose ? sample_lines(report) : summary_lines(report));
  return Done;
}

}  // namespace

Command sample_command(CLI::App& program) { return make_command<SampleArguments>(program); }

}  // namespace wscvt::program
