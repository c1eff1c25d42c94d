// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/output_paths.h"
#include "program/arguments/volume_arguments.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "toolbox/clump/sphere.h"
#include "toolbox/exchange/clump_files.h"
#include "toolbox/fabric/fabric.h"
#include "toolbox/fabric/fabric_files.h"
#include "toolbox/job/job_folder.h"
#include "toolbox/report/parts_report.h"
#include "toolbox/resolution/resolution.h"
#include "toolbox/volume/open_volume.h"
#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/output_file.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

namespace {

/// `wscvt describe`: measures a grain, compares it with a reference, or measures the contacts of a
/// volume of labels.
struct DescribeArguments {
  std::string grain;      ///< a mesh, spheres, or a volume of labels
  std::string reference;  ///< a mesh, or the grey values of the labels; empty: none
  std::string folder;     ///< of the contacts
  bool parts = false;     ///< each component of the grain is a convex part
  CommonArguments common;
  DetailedOptions options;
  FabricOptions fabric;
  VolumeChoice choice;
};

void check_files(const DescribeArguments& arguments) {
  check_output_paths({{"the grain", arguments.grain}, {"the reference", arguments.reference}},
                     named_reports(arguments.common.reports));
  if (!arguments.folder.empty()) {
    refuse(mention("output") + " is the folder for the contacts of a volume of labels. Give " +
           mention("report") + " for the report of a mesh.");
  }
}

/// Returns the size of a voxel in the unit of a mesh; empty if it is not given.
std::optional<double> size_of_voxel(const VolumeChoice& choice) {
  if (!choice.voxel_size) return {};
  const Vector3& size = *choice.voxel_size;
  if (size.minCoeff() < size.maxCoeff() || !choice.unit.empty()) {
    refuse("A mesh has one " + mention(voxel_size_option) +
           ", in its own unit. Give a number without a unit.");
  }
  return size[0];
}

void describe_mesh(const DescribeArguments& arguments) {
  const bool compares = !arguments.reference.empty();
  std::optional<double> voxel_size;
  checked([&] {
    if (!is_clump_file(arguments.grain)) check_mesh_input(arguments.grain);
    if (compares) check_mesh_input(arguments.reference);
    check_files(arguments);
    voxel_size = size_of_voxel(arguments.choice);
    for (const std::string& report : arguments.common.reports) {
      check_descriptor_report(report, compares, voxel_size.has_value());
    }
  });
  Work work(arguments.common.threads, arguments.common.quiet);
  std::vector<Sentence> warnings;
  const auto read = [&](const std::string& path, double begin, double end) {
    if (is_clump_file(path)) {
      return NamedMesh{path, sphere_union_mesh(read_clump(path), work.execution())};
    }
    MeshFile file = read_mesh_file(path, work.execution().part(begin, end));
    warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
    return NamedMesh{path, std::move(file.mesh)};
  };
  NamedMesh grain = read(arguments.grain, 0.0, 0.5 * reading_share);
  std::optional<NamedMesh> reference;
  if (compares) reference = read(arguments.reference, 0.5 * reading_share, reading_share);
  const double share = voxel_size ? 0.5 : 1.0;
  GrainMeasures measures = measure_grain(std::move(grain), std::move(reference), arguments.options,
                                         work.execution().part(reading_share, share));
  if (voxel_size) {
    add_resolution(measures, *voxel_size, arguments.options, work.execution().part(share, 1.0));
  }
  work.write_reports(arguments.common.reports, measures, origin_of(arguments.grain));
  const bool all = arguments.common.verbose;
  for (const Sentence& remark : remarks(measures, all)) warnings.push_back(remark);
  work.print(warnings, all ? descriptor_lines(measures) : summary_lines(measures));
}

void compare_parts(const DescribeArguments& arguments) {
  checked([&] {
    if (arguments.reference.empty()) {
      refuse(mention("parts") + " compares the parts with their grain. Give its mesh too.");
    }
    check_mesh_input(arguments.grain);
    check_mesh_input(arguments.reference);
    check_files(arguments);
    for (const std::string& report : arguments.common.reports) check_parts_report(report);
  });
  Work work(arguments.common.threads, arguments.common.quiet);
  const Execution reading = work.execution().part(0.0, reading_share);
  PartsResult result;
  result.parts = parts_of(read_mesh(arguments.grain, reading));
  MeshFile reference = read_mesh_file(arguments.reference, reading);
  result.warnings.assign(reference.warnings.begin(), reference.warnings.end());
  result.grain = check_mesh(std::move(reference.mesh), MeshCheckOptions(), reading).mesh;
  result.measures =
      measure_parts(result.parts, result.grain, work.execution().part(reading_share, 1.0));
  result.scan = describe_shape(result.grain, work.execution().part(1.0, 1.0));
  work.write_reports(arguments.common.reports, result, origin_of(arguments.grain));
  work.print(result.warnings, parts_lines(result));
}

void describe_labels(const DescribeArguments& arguments) {
  const auto in_folder = [&](const char* name) {
    return (std::filesystem::path(arguments.folder) / name).string();
  };
  std::unique_ptr<LabelVolume> labels;
  std::unique_ptr<LabelVolume> scan;
  checked([&] {
    labels = open_volume(arguments.grain, arguments.choice);
    if (arguments.folder.empty()) {
      refuse("A volume of labels needs a folder for its contacts. Give it with " +
             mention("output") + ".");
    }
    if (same_file(arguments.grain, arguments.folder)) {
      refuse("\"" + arguments.folder + "\" is the labels itself. Give an output folder.");
    }
    if (!arguments.common.reports.empty()) {
      refuse("The page of the contacts is in the folder. Leave out " + mention("report") + ".");
    }
    if (!arguments.reference.empty()) scan = open_volume(arguments.reference, arguments.choice);
  });
  CommonArguments common = arguments.common;
  common.threads = 1;  // the reading takes the time
  Work work(common.threads, common.quiet);
  const MadeFolder folder(arguments.folder);
  require_no_job(arguments.folder);
  require_own_table(arguments.folder, "grains.csv", fabric_grains_csv(Fabric()));
  require_own_table(arguments.folder, "contacts.csv", contacts_csv(Fabric()));
  check_writable(in_folder("contacts.csv"));
  FabricOptions options = arguments.fabric;
  options.scan = scan.get();
  const Fabric fabric = measure_fabric(*labels, options, work.execution());
  work.write_text(in_folder("contacts.csv"), [&] { return contacts_csv(fabric); });
  work.write_text(in_folder("grains.csv"), [&] { return fabric_grains_csv(fabric); });
  work.write_text(in_folder("contacts.vtp"), [&] { return contacts_vtp(fabric); });
  work.write_text(in_folder("fabric.html"),
                  [&] { return fabric_html(fabric, origin_of(arguments.grain)); });
  std::vector<std::string> lines = {labels->description()};
  lines.insert(lines.end(), labels->notes().begin(), labels->notes().end());
  for (std::string& line : fabric_lines(fabric)) lines.push_back(std::move(line));
  std::vector<Sentence> warnings = labels->warnings();
  if (scan) warnings.insert(warnings.end(), scan->warnings().begin(), scan->warnings().end());
  work.print(warnings, std::move(lines), arguments.folder,
             "Look at \"" + in_folder("fabric.html") + "\"");
}

CLI::App& add_arguments(CLI::App& program, DescribeArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"describe",
       "Measure a grain, compare it with a reference, or measure contacts",
       {"grain.stl --report grain.html --report grains.csv",
        "remesh.ply scan.ply --report difference.html", "clump.csv scan.ply",
        "remesh.ply scan.ply --parts", "labels.nrrd scan.tif -o contacts"},
       "Two meshes must have the same position: wscvt does not align them. Of labels, OUT gets "
       "contacts.csv (areas, normals and their uncertainty), grains.csv (coordination), "
       "contacts.vtp for ParaView, and the page fabric.html with rose diagrams.",
       true});
  add_file_argument(app, "grain", arguments.grain,
                    mesh_argument_text("Closed mesh", MeshUse::Read) +
                        "; a .csv of spheres (wscvt clump); or labels, in a format of wscvt "
                        "extract, whose contacts are measured")
      ->required();
  add_file_argument(app, "reference", arguments.reference,
                    "Mesh to which errors and distances are measured. Of labels, the grey values "
                    "from which wscvt segment made them: their blur then corrects areas and false "
                    "contacts");
  add_file_argument(app, "-o,--output", arguments.folder,
                    "Output folder, for the contacts of labels")
      ->type_name("OUT");
  app.add_flag(
      "--parts", arguments.parts,
      "Measure each connected part of GRAIN by itself, as convex parts: their distances and "
      "volume");
  add_number(app, arguments.options.roundness_ball, roundness_ball_option);
  add_number(app, arguments.options.roughness_cutoff, roughness_cutoff_option);
  add_choice_arguments(app, arguments.choice, finer_settings);
  CLI::Option* voxel_size = app.get_option("--" + std::string(voxel_size_option.key));
  voxel_size->description(voxel_size->get_description() +
                          ". Of a mesh, a number in its unit: adds the values without the voxels' "
                          "error, with intervals");
  voxel_size->group("Options");
  add_background_argument(app, arguments.fabric.background, finer_settings);
  add_common_arguments(app, arguments.common);
  add_verbose_argument(app, arguments.common.verbose);
  return app;
}

int run(const DescribeArguments& arguments) {
  if (arguments.parts) {
    compare_parts(arguments);
  } else if (is_volume(arguments.grain)) {
    describe_labels(arguments);
  } else {
    describe_mesh(arguments);
  }
  return Done;
}

}  // namespace

Command describe_command(CLI::App& program) { return make_command<DescribeArguments>(program); }

}  // namespace wscvt::program
