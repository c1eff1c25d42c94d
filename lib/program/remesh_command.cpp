// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_command.h"

#include <utility>
#include <vector>

#include "command.h"
#include "exit_code.h"
#include "output_paths.h"
#include "remesh_arguments.h"
#include "work.h"
#include "wscvt/remesh.h"
#include "wscvt/report/coefficients_file.h"
#include "wscvt/report/report.h"
#include "wscvt/report/report_file.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt::program {

CLI::App& add_command(CLI::App& program, RemeshArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"remesh",
       "Remesh a dense scan of a grain to exactly N nodes",
       {"scan.ply remesh.ply -n 1000 --report remesh.html",
        "scan.ply remesh.ply -w error-adaptive -r 60 --report table.csv",
        "scan.ply remesh.ply --target 0.5"},
       "A remesh of the same scan, options and version has the same bytes on any number of "
       "threads.\n"
       "What a report prints as an option is what one types: \"weighting\": \"area\" is "
       "--weighting=area.",
       true});
  add_file_argument(app, "scan", arguments.scan, "Scan: PLY, STL, OBJ or OFF")->required();
  add_file_argument(app, "output", arguments.output, "Remesh: PLY, STL, OBJ or OFF")->required();
  add_remesh_arguments(app, arguments.options);
  add_common_arguments(app, arguments.common);
  add_file_argument(app, "--coefficients", arguments.coefficients,
                    "Write the fitted series to this file as JSON");
  return app;
}

int run(const RemeshArguments& arguments) {
  const CommonArguments& common = arguments.common;
  std::vector<NamedFile> outputs = named_reports(common.reports);
  outputs.insert(outputs.begin(),
                 {{"the remesh", arguments.output}, {"the coefficients", arguments.coefficients}});
  check_output_paths({{"the scan", arguments.scan}}, outputs, common.overwrite);
  for (const std::string& report : common.reports) check_remesh_report(report);
  check_mesh_format(arguments.output);
  RemeshOptions options = arguments.options;
  options.measures.coefficients = !arguments.coefficients.empty();

  Work work(common);
  work.execution().report(0.0, "Reading the scan");
  IndexedMesh scan = read_mesh(arguments.scan);
  IndexedMesh shown;  // on a page
  if (!common.reports.empty()) shown = scan;
  const RemeshResult result = remesh(std::move(scan), options, work.execution());
  work.end();

  write_mesh(result.mesh, arguments.output);
  for (const std::string& report : common.reports) {
    write_report(report, result, shown, origin_of(arguments.scan), Execution(common.threads));
  }
  if (!arguments.coefficients.empty()) write_coefficients(arguments.coefficients, result);
  work.print(result.warnings, report_lines(result));
  return Done;
}

}  // namespace wscvt::program
