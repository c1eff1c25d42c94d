// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/arguments/common_arguments.h"

#include <filesystem>

#include "program/call/command.h"
#include "toolbox/exchange/clump_files.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/error.h"
#include "wscvt/base/option.h"

namespace wscvt::program {

void add_threads_argument(CLI::App& app, int& threads) {
  add_number(app, "-t,--threads", threads, threads_option);
}

void add_verbose_argument(CLI::App& app, bool& verbose) {
  app.add_flag("-v,--verbose", verbose, "Print the whole report, not only its summary");
}

void add_folder_argument(CLI::App& app, std::string& folder) {
  app.add_option("-o,--output", folder, "Output folder")->type_name("OUT")->required();
}

void add_quiet_argument(CLI::App& app, bool& quiet) {
  app.add_flag("-q,--quiet", quiet, "Print only warnings and failures");
}

void add_shard_argument(CLI::App& app, Shard& shard) {
  add_typed(app, "--shard", [&shard](std::string_view text) { shard = shard_of(text); })
      ->description(
          "Use only part I of N of the grains, by their names. Afterwards, the same call without "
          "this option joins the parts")
      ->type_name("I/N");
}

void add_format_argument(CLI::App& app, std::string& format) {
  app.add_option("--format", format,
                 "Ending of the meshes: " + mesh_extensions(MeshUse::Write) +
                     ", without the point. Default: ply")
      ->type_name("NAME");
}

void check_mesh_input(const std::string& path) {
  refuse_volume_input(path, ways_of_volumes);
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    refuse(
        "\"" + path +
        "\" is a folder. wscvt batch FOLDER -o OUT remeshes all meshes in it; this command takes "
        "one file.");
  }
  refuse_spheres(path);
  check_mesh_format(path, MeshUse::Read);
}

void refuse_spheres(const std::string& path) {
  if (is_mesh_file(path) || !has_sphere_heading(path)) return;
  refuse("\"" + path +
         "\" is a table of spheres, as of a clump, not a mesh. wscvt describe CLUMP.csv SCAN "
         "measures it.");
}

std::string mesh_argument_text(const std::string& what, MeshUse use) {
  return what + ": " + mesh_extensions(use);
}

CLI::Option* add_file_argument(CLI::App& app, const std::string& names, std::string& file,
                               const std::string& description) {
  return app.add_option(names, file, description)->type_name("FILE");
}

void add_common_arguments(CLI::App& app, CommonArguments& arguments) {
  app.add_option("--report", arguments.reports,
                 "Write the report to this file: .html (pictures and histograms), .json (all "
                 "values) or .csv (appends one row to a table). May be given more than once")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_threads_argument(app, arguments.threads);
  app.add_flag("-q,--quiet", arguments.quiet, "Print only warnings");
}

}  // namespace wscvt::program
