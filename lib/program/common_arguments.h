// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "wscvt/scan/mesh_io.h"

namespace wscvt::program {

/// What every command that works on a grain takes.
struct CommonArguments {
  std::vector<std::string> reports;  ///< files; the ending says what each becomes
  int threads = 0;                   ///< 0: all
  bool overwrite = false;            ///< an output may replace an input
  bool quiet = false;
};

/// Adds them. Reading a call changes `arguments`, which must outlive `app`. A command whose only
/// output is the report has it as -o too.
void add_common_arguments(CLI::App& app, CommonArguments& arguments,
                          const std::string& names_of_report = "--report");

/// Adds the number of threads alone.
void add_threads_argument(CLI::App& app, int& threads);

/// Adds -o, the folder of a command that makes many files. It has to be given.
void add_folder_argument(CLI::App& app, std::string& folder);

/// Adds -q of a command that works on many grains.
void add_quiet_argument(CLI::App& app, bool& quiet);

/// Adds --format, the ending of many meshes.
void add_format_argument(CLI::App& app, std::string& format);

/// Throws wscvt::Error(InvalidInput) for an ending that no mesh is written with.
void check_format(const std::string& format);

/// What help says of a mesh that is read or written: "Scan: .ply, .stl or .obj".
std::string mesh_argument_text(const std::string& what, MeshUse use);

/// Adds one file; it is empty where it is not given.
CLI::Option* add_file_argument(CLI::App& app, const std::string& names, std::string& file,
                               const std::string& description);

}  // namespace wscvt::program
