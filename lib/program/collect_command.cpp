// SPDX-License-Identifier: GPL-3.0-or-later
#include "collect_command.h"

#include "command.h"
#include "common_arguments.h"
#include "exit_code.h"
#include "output_paths.h"
#include "toolbox/job/remesh_job.h"
#include "toolbox/report/sample_summary.h"
#include "toolbox/report/sample_table.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

CLI::App& add_command(CLI::App& program, CollectArguments& arguments) {
  CLI::App& app = add_command(
      program, {"collect",
                "Join the tables of a batch that ran in parts",
                {"out/grains-*-of-2.csv -o grains.csv",
                 "out/grains-*-of-2.csv -o grains.csv --report summary.html"},
                "Rows are in the order of the grains' names. The number of parts does not matter.",
                false,
                true});
  app.add_option("tables", arguments.tables, "Tables that wscvt batch --shard wrote")
      ->type_name("FILE")
      ->required();
  add_file_argument(app, "-o,--output", arguments.output, "The joined table")->required();
  app.add_option("--report", arguments.summaries,
                 "Write the summary to this file, .html or .json. May be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_flag("-q,--quiet", arguments.quiet, "Do not print the summary");
  return app;
}

int run(const CollectArguments& arguments) {
  std::vector<NamedFile> outputs = named_reports(arguments.summaries);
  outputs.insert(outputs.begin(), {"the table", arguments.output});
  std::vector<NamedFile> inputs;
  for (const std::string& table : arguments.tables) inputs.push_back({"a part", table});
  checked([&] {
    check_output_paths(inputs, outputs, false);
    for (const std::string& summary : arguments.summaries) check_summary(summary);
  });
  if (is_without_summary(arguments.tables.front())) {
    if (!arguments.summaries.empty()) {
      throw WrongCall(
          "Only tables of remeshes have a summary. Leave out --report. wscvt sample reads tables "
          "of "
          "shapes.");
    }
    join_tables(arguments.tables, arguments.output);
    return Done;
  }
  join_tables(arguments.tables, arguments.output);
  const SampleSummary summary = summarise_table(arguments.output);
  for (const std::string& file : arguments.summaries) {
    write_summary(file, summary, remeshes_beside(arguments.tables));
  }
  print(summary_lines(summary), arguments.quiet);
  return summary.failed == 0 ? Done : SomeFailed;
}

}  // namespace wscvt::program
