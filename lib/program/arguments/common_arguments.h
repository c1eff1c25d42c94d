// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "toolbox/job/grain_files.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt::program {

/// Arguments of every command that works on one grain.
struct CommonArguments {
  std::vector<std::string> reports;  ///< files; the ending selects the format
  int threads = 0;                   ///< 0: all
  bool quiet = false;
  bool verbose = false;  ///< the whole report
};

/// Adds the arguments. Parsing changes `arguments`, which must outlive `app`.
void add_common_arguments(CLI::App& app, CommonArguments& arguments);

/// Adds -v, the whole log of a remesh.
void add_verbose_argument(CLI::App& app, bool& verbose);

/// Adds only the number of threads.
void add_threads_argument(CLI::App& app, int& threads);

/// Adds -o, the required output folder of a command that makes many files.
void add_folder_argument(CLI::App& app, std::string& folder);

/// Adds -q of a command that works on many grains.
void add_quiet_argument(CLI::App& app, bool& quiet);

/// Adds --shard, a part of many grains.
void add_shard_argument(CLI::App& app, Shard& shard);

/// Adds --format, the ending of many meshes.
void add_format_argument(CLI::App& app, std::string& format);

/// What to do with a volume, where a mesh or a table is needed.
inline constexpr const char* ways_of_volumes =
    "wscvt batch VOLUME -o OUT remeshes and measures its labels, and wscvt sample OUT then has "
    "their statistics. wscvt extract VOLUME OUT writes a mesh of each. Grey values become labels "
    "by wscvt segment VOLUME LABELS.nrrd first.";

/// Throws wscvt::Error(InvalidInput) for an input that is not a mesh, with the command for it: a
/// volume, a folder, a table of spheres, another ending.
void check_mesh_input(const std::string& path);

/// Throws wscvt::Error(InvalidInput), with the command for it, for a table that names spheres.
void refuse_spheres(const std::string& path);

/// Returns the help text of a mesh that is read or written: "Scan: .ply, .stl or .obj".
std::string mesh_argument_text(const std::string& what, MeshUse use);

/// Adds an argument for one file; empty if it is not given.
CLI::Option* add_file_argument(CLI::App& app, const std::string& names, std::string& file,
                               const std::string& description);

/// Adds an argument for every option of both methods (is_option_of), under the option's key. Users
/// type options as reports print them. Parsing changes `options`, which must outlive `app`. Their
/// values before are the defaults of their method. A call with an option of the other method is
/// refused, with the option to use instead. Help texts are made from the options' tables and
/// ranges.
void add_remesh_arguments(CLI::App& app, RemeshOptions& options,
                          Remeshed remeshed = Remeshed::Scan);

}  // namespace wscvt::program
