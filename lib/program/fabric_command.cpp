// SPDX-License-Identifier: GPL-3.0-or-later
#include "fabric_command.h"

#include <filesystem>
#include <memory>

#include "command.h"
#include "common_arguments.h"
#include "exit_code.h"
#include "output_paths.h"
#include "toolbox/fabric/fabric_files.h"
#include "toolbox/fabric/fabric_page.h"
#include "toolbox/volume/open_volume.h"
#include "volume_arguments.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"

namespace wscvt::program {

CLI::App& add_command(CLI::App& program, FabricArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"fabric",
       "Measure the contacts of the grains of a segmented CT volume",
       {"labels.nrrd -o out --scan scan.tif", "labels.tif -o out --voxel-size 12um"},
       "OUT gets contacts.csv (areas, normals and their uncertainty), grains.csv (coordination),\n"
       "contacts.vtp for ParaView, and the page fabric.html with rose diagrams."});
  add_file_argument(app, "labels", arguments.labels, "Labels, in a format of wscvt extract")
      ->required();
  add_folder_argument(app, arguments.folder);
  add_file_argument(
      app, "--scan", arguments.scan,
      "Grey values from which wscvt segment made the labels. Their blur then corrects "
      "areas and false contacts. Default: the labels are exact");
  add_background_argument(app, arguments.options.background, "Options");
  add_choice_arguments(app, arguments.choice, "Options");
  add_quiet_argument(app, arguments.quiet);
  return app;
}

int run(const FabricArguments& arguments) {
  const auto in_folder = [&](const char* name) {
    return (std::filesystem::path(arguments.folder) / name).string();
  };
  std::unique_ptr<LabelVolume> labels;
  std::unique_ptr<LabelVolume> scan;
  checked([&] {
    if (same_file(arguments.labels, arguments.folder)) {
      refuse("\"" + arguments.folder + "\" is the labels itself. Give an output folder.");
    }
    labels = open_volume(arguments.labels, arguments.choice);
    if (!arguments.scan.empty()) scan = open_volume(arguments.scan, arguments.choice);
  });
  CommonArguments common;
  common.threads = 1;  // the reading takes the time
  common.quiet = arguments.quiet;
  Work work(common);
  const MadeFolder folder(arguments.folder);
  check_writable(in_folder("contacts.csv"));
  FabricOptions options = arguments.options;
  options.scan = scan.get();
  const Fabric fabric = measure_fabric(*labels, options, work.execution());
  const auto write = [&](const char* name, const auto& content) {
    work.write(in_folder(name),
               [&](const std::string& path, const Execution&) { write_file(path, content()); });
  };
  write("contacts.csv", [&] { return contacts_csv(fabric); });
  write("grains.csv", [&] { return fabric_grains_csv(fabric); });
  write("contacts.vtp", [&] { return contacts_vtp(fabric); });
  write("fabric.html", [&] { return fabric_html(fabric, origin_of(arguments.labels)); });
  std::vector<std::string> lines = {labels->description()};
  lines.insert(lines.end(), labels->notes().begin(), labels->notes().end());
  for (std::string& line : fabric_lines(fabric)) lines.push_back(std::move(line));
  lines.push_back("Look at \"" + in_folder("fabric.html") + "\"");
  work.print(labels->warnings(), lines);
  return Done;
}

}  // namespace wscvt::program
