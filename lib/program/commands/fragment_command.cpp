// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/App.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "program/arguments/common_arguments.h"
#include "program/arguments/output_paths.h"
#include "program/arguments/simulation_arguments.h"
#include "program/call/command.h"
#include "program/call/exit_code.h"
#include "program/commands/commands.h"
#include "program/terminal/work.h"
#include "toolbox/conforming/conforming_files.h"
#include "toolbox/conforming/conforming_grains.h"
#include "toolbox/exchange/fragment_files.h"
#include "toolbox/exchange/part_files.h"
#include "toolbox/exchange/rockable_shape.h"
#include "toolbox/fragment/fragments.h"
#include "toolbox/job/job_folder.h"
#include "toolbox/sample/given_sizes.h"
#include "toolbox/sample/grain_grower.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::program {

namespace {

/// `wscvt fragment`: divides a grain into fragments that fill it.
struct FragmentArguments {
  std::string grain;
  std::string folder;
  std::string format = "ply";
  FragmentOptions options;
  std::string sizes;              ///< file of a size curve; empty: about equal
  std::vector<std::string> near;  ///< points, "x,y,z"
  ConformingOptions walls;        ///< of a remesh, if one is asked for
  double density = 1.0;
  TetrahedraArguments tetrahedra;
  CommonArguments common;
};

namespace fs = std::filesystem;

Vector3 point_of(const std::string& text) {
  Vector3 point;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [rest, error] = std::from_chars(at, end, point[axis]);
    const bool is_last = axis == 2;
    if (error != std::errc() || (is_last ? rest != end : rest == end || *rest != ',')) {
      refuse("\"" + text + "\" is not a point. Give --near three numbers, as 1.5,0,-2.");
    }
    at = rest + (is_last ? 0 : 1);
  }
  return point;
}

FragmentOptions options_of(const FragmentArguments& arguments) {
  FragmentOptions options = arguments.options;
  if (!arguments.sizes.empty()) {
    options.volumes = fragment_volumes(read_given_sizes(arguments.sizes), options.count);
  }
  for (const std::string& text : arguments.near) options.near.push_back(point_of(text));
  check_options(options);
  return options;
}

/// Whether the fragments' walls are remeshed. Cut walls have triangles that are too thin to fill.
bool is_remeshed(const FragmentArguments& arguments) {
  return arguments.walls.nodes > 0 || arguments.walls.edge_length > 0.0 ||
         !arguments.tetrahedra.files.empty();
}

/// Refuses a folder with the fragments of another grain, told apart by the volume. Returns whether
/// it has these fragments, maybe in another format.
bool require_same_grain(const std::string& folder, const Fragments& fragments) {
  const double volume = fragments.grain.volume;
  const double allowed = 1e-6 * volume;  // of files of single precision
  const std::vector<double> volumes =
      volumes_of_fragments((fs::path(folder) / "fragments.csv").string());
  const double sum = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  if (sum == 0.0 || std::abs(sum - volume) <= allowed) {
    return std::equal(
        volumes.begin(), volumes.end(), fragments.list.begin(), fragments.list.end(),
        [&](double one, const Fragment& f) { return std::abs(one - f.mass.volume) <= allowed; });
  }
  refuse(
      "The folder \"" + folder +
      "\" has the fragments of another grain, which would be replaced: their volumes add up to " +
      format_number(sum, 8) + ", and this grain has " + format_number(volume, 8) +
      ". Give another folder with " + mention("output") + ".");
}

/// Returns a warning for the fragment with the least moment of inertia, see inertia_warning.
Sentence inertia_warning_of(const Fragments& fragments, const fs::path& folder,
                            const std::vector<std::string>& files, double density) {
  const auto least = [](const Fragment& one) { return one.mass.principal_moments.minCoeff(); };
  const auto smallest =
      std::min_element(fragments.list.begin(), fragments.list.end(),
                       [&](const Fragment& a, const Fragment& b) { return least(a) < least(b); });
  const std::string& file = files[smallest - fragments.list.begin()];
  return inertia_warning((folder / file).string(), smallest->mass, density,
                         "the grain's coordinates");
}

CLI::App& add_arguments(CLI::App& program, FragmentArguments& arguments) {
  CLI::App& app = add_command(
      program,
      {"fragment",
       "Divide a grain into fragments that fill it, for breakage",
       {"grain.ply -k 20 -o fragments", "grain.ply -k 50 -o fragments --near 0,0,1.2 --format obj",
        "grain.ply -k 100 -o fragments --size-curve sieve.csv",
        "grain.ply -k 20 -o fragments -n 200 --format shp"},
       "OUT gets fragment_1.ply to fragment_K.ply, fragments.csv, and contacts.csv with the area, "
       "centre and normal of each wall. Two fragments have the same triangles on their wall, and "
       "keep all points of the surface. With -n, --edge-length or --tetrahedra they are remeshed "
       "with even edges."});
  add_file_argument(app, "grain", arguments.grain, mesh_argument_text("Grain", MeshUse::Read))
      ->required();
  add_folder_argument(app, arguments.folder);
  add_number(app, "-k,--count", arguments.options.count, fragment_count_option);
  add_file_argument(app, "--size-curve", arguments.sizes,
                    "Size curve, a CSV file of two columns: equivalent diameter, % finer by mass. "
                    "Its sizes are scaled to the grain. Default: about equal volumes");
  app.add_option("--near", arguments.near,
                 "Smaller fragments near this point, such as a contact; coordinates as 1.5,0,-2. "
                 "May be given more than once")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false);
  add_number(app, "--seed", arguments.options.seed, sample_seed_option);
  add_number(app, "-n,--nodes", arguments.walls.nodes, wall_nodes_option)
      ->description("Remesh all fragments at once with about this number of nodes of each");
  add_number(app, "--edge-length", arguments.walls.edge_length, edge_length_option)
      ->description("Remesh all fragments at once with this mean edge length");
  app.add_option("--format", arguments.format,
                 "Ending of the fragments' files: that of a mesh, urdf, xml (MuJoCo) or shp "
                 "(Rockable, exaDEM). Default: ply")
      ->type_name("NAME");
  add_number(app, "--density", arguments.density, parts_density_option);
  add_tetrahedra_arguments(app, arguments.tetrahedra, "the fragments");
  add_threads_argument(app, arguments.common.threads);
  app.add_flag("-q,--quiet", arguments.common.quiet, "Print only warnings");
  return app;
}

int run(const FragmentArguments& arguments) {
  const fs::path folder = arguments.folder;
  std::vector<std::string> files;
  const FragmentOptions options = checked([&] {
    check_mesh_input(arguments.grain);
    check_fragment_format(arguments.format);
    check_conforming_options(arguments.walls);
    require_in_range(arguments.density, parts_density_option);
    check_tetrahedra_arguments(arguments.tetrahedra);
    FragmentOptions read = options_of(arguments);
    for (int k = 1; k <= read.count; ++k) {
      files.push_back("fragment_" + std::to_string(k) + "." + arguments.format);
      const std::string path = (folder / files.back()).string();
      std::vector<std::string> made = parts_beside(path, 1);
      made.push_back(path);
      for (const std::string& one : made) {
        if (!same_file(one, arguments.grain)) continue;
        refuse("\"" + one + "\" is the grain itself. Give another folder.");
      }
    }
    return read;
  });
  Work work(arguments.common.threads, arguments.common.quiet);
  const double cut_share = is_remeshed(arguments) ? 0.3 : 1.0;
  MeshFile file = read_mesh_file(arguments.grain, work.execution().part(0.0, reading_share));
  Fragments fragments = fragment_grain(std::move(file.mesh), options,
                                       work.execution().part(reading_share, cut_share));
  std::vector<Sentence> warnings(file.warnings.begin(), file.warnings.end());
  warnings.insert(warnings.end(), fragments.warnings.begin(), fragments.warnings.end());
  std::vector<std::string> lines;
  if (is_remeshed(arguments)) {
    const ConformingGrains remeshed =
        remesh_fragments(fragments, arguments.walls, work.execution().part(cut_share, 1.0));
    lines = conforming_lines(remeshed);
    const std::vector<Sentence> found = conforming_warnings(remeshed);
    warnings.insert(warnings.end(), found.begin(), found.end());
  }
  const std::vector<std::string> about = fragment_lines(fragments);
  lines.insert(lines.begin(), about.begin(), about.end());
  const bool are_same = checked([&] {
    require_no_job(arguments.folder);
    require_own_table(arguments.folder, "fragments.csv", fragments_csv(Fragments(), {}));
    require_own_table(arguments.folder, "contacts.csv", fragment_contacts_csv(Fragments()));
    return require_same_grain(arguments.folder, fragments);
  });
  const OlderFiles older(arguments.folder, {"fragments.csv"});
  const MadeFolder made(arguments.folder);
  std::vector<Rounding> roundings(files.size());
  for (std::size_t k = 0; k < files.size(); ++k) {
    const std::string path = (folder / files[k]).string();
    const Fragment& one = fragments.list[k];
    work.write(path,
               [&] { roundings[k] = write_fragment(path, one.mesh, one.mass, arguments.density); });
  }
  const Sentence refused = inertia_warning_of(fragments, folder, files, arguments.density);
  if (!refused.empty()) warnings.push_back(refused);
  const std::vector<std::string> rounded = rounding_lines(roundings);
  lines.insert(lines.end(), rounded.begin(), rounded.end());
  work.write_text((folder / "fragments.csv").string(),
                  [&] { return fragments_csv(fragments, files); });
  work.write_text((folder / "contacts.csv").string(),
                  [&] { return fragment_contacts_csv(fragments); });
  const auto filled = write_all_tetrahedra(arguments.tetrahedra, work, [&] {
    std::vector<IndexedMesh> meshes;
    std::vector<std::string> names;
    for (const Fragment& one : fragments.list) {
      meshes.push_back(one.mesh);
      names.push_back(std::to_string(names.size() + 1));
    }
    return tetrahedra_in(meshes, "fragment", names, arguments.walls.edge_length, work.execution());
  });
  lines.insert(lines.end(), filled.begin(), filled.end());
  for (std::string& line : older.remove_but(files, arguments.grain, are_same))
    lines.push_back(std::move(line));
  work.print(warnings, std::move(lines), arguments.folder);
  return Done;
}

}  // namespace

Command fragment_command(CLI::App& program) { return make_command<FragmentArguments>(program); }

}  // namespace wscvt::program
