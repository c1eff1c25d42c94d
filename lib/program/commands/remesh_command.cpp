// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/output_paths.h"
#include "program/arguments/simulation_arguments.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "toolbox/exchange/rockable_shape.h"
#include "toolbox/exchange/tetrahedra_files.h"
#include "toolbox/map/scan_harmonics.h"
#include "wscvt/base/text.h"
#include "wscvt/measures/carried_attributes.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/report/report_addition.h"

namespace wscvt::program {

namespace {

/// `wscvt remesh`: reads one scan and writes its remesh and reports.
struct RemeshArguments {
  std::string scan;
  std::string output;
  std::string coefficients;  ///< file; empty: no file
  CommonArguments common;
  RemeshOptions options;
  SimulationArguments simulation;
};

CLI::App& add_arguments(CLI::App& program, RemeshArguments& arguments) {
  CLI::App& app = add_command(
      program, {"remesh",
                "Remesh a dense scan of a grain to exactly N nodes",
                {"scan.ply remesh.ply -n 1000 --report remesh.html",
                 "scan.ply remesh.ply --edge-ratio 1.4 --report table.csv",
                 "scan.ply remesh.ply --max-error 0.5",
                 "scan.ply remesh.ply --frame principal --node-table nodes.csv --sdf grid.npy"},
                "The same scan, options and version give the same bytes on any number of threads.\n"
                "Reports print options as users type them: \"weighting\": \"wscvt-c\" is "
                "--weighting=wscvt-c.",
                true});
  add_file_argument(app, "scan", arguments.scan, mesh_argument_text("Scan", MeshUse::Read))
      ->required();
  add_output(app, "output", arguments.output, mesh_argument_text("Remesh", MeshUse::Write));
  add_remesh_arguments(app, arguments.options);
  add_simulation_arguments(app, arguments.simulation);
  add_common_arguments(app, arguments.common);
  add_verbose_argument(app, arguments.common.verbose);
  add_file_argument(
      app, "--coefficients", arguments.coefficients,
      "Write the coefficients of the SH series to this file: .json, or .sh (SHTOOLS, 4pi)");
  move_to_finer_settings(app, {"--threads", "--quiet", "--verbose", "--coefficients"});
  return app;
}

/// Throws wscvt::Error for a name with another ending than .json or .sh. check_writable checks
/// pipes, devices and folders.
void check_coefficients_path(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const bool is_other =
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (path.empty() || is_other || ending_of(path) == ".json" || ending_of(path) == ".sh") return;
  refuse("\"" + path +
         "\" is no name for coefficients. Give a name that ends in .json, or in .sh for SHTOOLS.");
}

/// Fills the remesh with tetrahedra, if the call asks for it. Returns lines for the log. If they
/// cannot be made, prints the remesh's warnings first, because they may say why.
std::vector<std::string> fill(const TetrahedraArguments& tetrahedra, const RemeshResult& result,
                              const SimulationFrame& frame, Work& work,
                              std::vector<ReportAddition>& additions) {
  return write_all_tetrahedra(tetrahedra, work, [&] {
    try {
      TetrahedralMesh body =
          tetrahedra_in(in_frame(result.mesh, frame), tetrahedra.edge, work.execution());
      additions.push_back(tetrahedra_addition(body));
      return body;
    } catch (const Error&) {
      print_warnings({result.warnings.begin(), result.warnings.end()});
      throw;
    }
  });
}

int run(const RemeshArguments& arguments) {
  const CommonArguments& common = arguments.common;
  std::vector<NamedFile> outputs = named_reports(common.reports);
  outputs.insert(outputs.begin(),
                 {{"the remesh", arguments.output}, {"the coefficients", arguments.coefficients}});
  const SimulationArguments& simulation = arguments.simulation;
  const std::vector<NamedFile> simulation_files = named_simulation_files(simulation);
  outputs.insert(outputs.end(), simulation_files.begin(), simulation_files.end());
  checked([&] {
    check_options(arguments.options);
    check_simulation_arguments(simulation);
    check_mesh_input(arguments.scan);
    check_mesh_format(arguments.output, MeshUse::Write);
    check_coefficients_path(arguments.coefficients);
    check_output_paths({{"the scan", arguments.scan}}, outputs);
    for (const std::string& report : common.reports) check_remesh_report(report);
  });
  RemeshOptions options = arguments.options;
  if (!arguments.coefficients.empty()) options.measures.series = scan_harmonics;
  // For pages and signed distances.
  options.measures.repaired_scan =
      std::any_of(common.reports.begin(), common.reports.end(), shows_scan) ||
      !simulation.grids.empty();

  options.measures.written = [path = arguments.output,
                              frame = simulation.options.frame](const RemeshResult& result) {
    return as_written(in_frame(result.mesh, simulation_frame(result.scan, frame)), path);
  };

  Work work(common.threads, common.quiet);
  MeshFile file = read_mesh_file(arguments.scan, work.execution().part(0.0, reading_share));
  if (!simulation.grids.empty()) {
    checked([&] {
      check_grid_of(file.mesh, options, simulation.options,
                    work.execution().part(reading_share, reading_share));
    });
  }
  // The scan as read, the source of the remesh's colours and labels.
  const bool carries = holds_attributes(arguments.output) && !file.attributes.empty();
  if (carries)
    read_pictures(file, arguments.scan, work.execution().part(reading_share, reading_share));
  const IndexedMesh scan = carries ? file.mesh : IndexedMesh();
  RemeshResult result =
      remesh(std::move(file.mesh), options, work.execution().part(reading_share, 1.0));
  result.warnings.insert(result.warnings.begin(), file.warnings.begin(), file.warnings.end());

  const ReportOrigin origin = origin_of(arguments.scan);
  const SimulationFrame frame = simulation_frame(result.scan, simulation.options.frame);
  work.write(arguments.output, [&] {
    const MeshAttributes attributes =
        carries ? carried_attributes(scan, file.attributes, result.mesh, work.writing())
                : MeshAttributes();
    write_mesh(in_frame(result.mesh, frame), attributes, arguments.output);
  });
  std::vector<Rounding> roundings;
  for (const std::string& nodes : simulation.nodes) {
    work.write(nodes, [&] { roundings.push_back(write_nodes(nodes, result, simulation.options)); });
  }
  for (const std::string& grid : simulation.grids) {
    work.write(grid, [&] {
      write_distance_grid(grid, result, simulation.options, origin, work.writing());
    });
  }
  std::vector<ReportAddition> additions;
  std::vector<std::string> lines = rounding_lines(roundings);
  const auto filled = fill(simulation.tetrahedra, result, frame, work, additions);
  lines.insert(lines.end(), filled.begin(), filled.end());
  work.write_reports(common.reports, result, origin, additions);
  if (!arguments.coefficients.empty()) {
    work.write(arguments.coefficients, [&] { write_coefficients(arguments.coefficients, result); });
  }
  work.print_log(result, common.verbose, lines);
  return Done;
}

}  // namespace

Command remesh_command(CLI::App& program) { return make_command<RemeshArguments>(program); }

}  // namespace wscvt::program
