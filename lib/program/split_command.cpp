// SPDX-License-Identifier: GPL-3.0-or-later
#include "split_command.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "command.h"
#include "exit_code.h"
#include "output_paths.h"
#include "toolbox/job/grain_files.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/bodies.h"

namespace wscvt::program {

namespace {

namespace fs = std::filesystem;

constexpr NumberOption<double> smallest_body_option = {
    "smallest",
    "volume of the smallest body",
    0.0,
    100.0,
    Ends::Both,
    "in % of the largest body's volume. Smaller bodies, and open surfaces, are only listed"};

std::string table_header() {
  return csv_record({"body", "state", "volume", "pores", "pore_volume", "boundary_edges", "x_min",
                     "y_min", "z_min", "x_max", "y_max", "z_max", "vertices", "faces", "file",
                     "name"});
}

/// Returns the row of a body; `file` is empty if the body is open or too small.
std::string table_row(std::size_t number, const MeshBody& body, const std::string& file) {
  std::vector<std::string> fields = {
      std::to_string(number),
      !body.is_closed() ? "open" : file.empty() ? "too small" : "written",
      format_exact(body.volume),
      std::to_string(body.pores),
      format_exact(body.pore_volume),
      std::to_string(body.boundary_edges)};
  Vector3 low = body.mesh.points.front();
  Vector3 high = low;
  for (const Vector3& p : body.mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (const Vector3& corner : {low, high}) {
    for (const double coordinate : corner) fields.push_back(format_exact(coordinate));
  }
  fields.push_back(std::to_string(body.mesh.points.size()));
  fields.push_back(std::to_string(body.mesh.triangles.size()));
  fields.push_back(file);
  fields.push_back(body.name);
  return csv_record(fields);
}

std::string summary_of(const std::vector<MeshBody>& bodies, std::size_t written) {
  std::size_t pores = 0;
  std::size_t open = 0;
  for (const MeshBody& body : bodies) {
    pores += body.pores;
    if (!body.is_closed()) ++open;
  }
  std::string text = std::to_string(bodies.size()) +
                     (bodies.size() == 1 ? " body: " : " bodies: ") + std::to_string(written) +
                     " written";
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + what;
  };
  add(bodies.size() - written - open, " too small");
  add(open, " open and only listed");
  add(pores, pores == 1 ? " pore in them" : " pores in them");
  return text;
}

}  // namespace

CLI::App& add_command(CLI::App& program, SplitArguments& arguments) {
  CLI::App& app = add_command(
      program, {"split",
                "Split a mesh of several bodies into one file per body",
                {"sample.stl bodies", "sample.stl bodies --smallest 0.1 --format stl"},
                "FOLDER gets 1.ply, 2.ply, ... in the order of the file, and bodies.csv. A closed "
                "surface inside a\nbody is a pore and stays with the body. wscvt batch --parts "
                "remeshes the bodies of a mesh\ndirectly."});
  add_file_argument(app, "mesh", arguments.mesh, mesh_argument_text("Mesh", MeshUse::Read))
      ->required();
  add_output(app, "folder", arguments.folder, "Output folder", "FOLDER");
  add_format_argument(app, arguments.format);
  add_number(app, "--" + std::string(smallest_body_option.key), arguments.smallest,
             smallest_body_option);
  add_threads_argument(app, arguments.common.threads);
  app.add_flag("--overwrite", arguments.common.overwrite, "Allow an output to replace the mesh");
  app.add_flag("-q,--quiet", arguments.common.quiet, "Print only warnings");
  return app;
}

int run(const SplitArguments& arguments) {
  const fs::path folder = arguments.folder;
  const std::string table = (folder / "bodies.csv").string();
  checked([&] {
    check_mesh_input(arguments.mesh);
    check_format(arguments.format);
    if (same_file(arguments.mesh, arguments.folder)) {
      refuse("\"" + arguments.mesh + "\" is the mesh itself. Give an output folder.");
    }
  });
  Work work(arguments.common);
  MeshFile file = read_mesh_file(arguments.mesh, work.execution().part(0.0, 0.5));
  MeshBodies split = split_bodies(std::move(file.mesh), std::move(file.named_faces),
                                  work.execution().part(0.5, 0.9));
  const std::vector<MeshBody> bodies = std::move(split.list);
  file.warnings.insert(file.warnings.end(), split.warnings.begin(), split.warnings.end());
  double largest = 0.0;
  for (const MeshBody& body : bodies) largest = std::max(largest, body.volume);
  std::vector<std::string> files;
  for (const MeshBody& body : bodies) {
    const bool is_taken = body.is_closed() && body.volume >= 0.01 * arguments.smallest * largest;
    files.push_back(is_taken ? std::to_string(files.size() + 1) + "." + arguments.format : "");
  }
  std::error_code error;
  fs::create_directories(folder, error);
  check_writable(table);
  for (const std::string& name : files) {
    if (name.empty() || arguments.common.overwrite) continue;
    checked([&] {
      if (!same_file((folder / name).string(), arguments.mesh)) return;
      refuse("\"" + (folder / name).string() +
             "\" is the mesh itself. Give another folder, or use --overwrite to replace it.");
    });
  }
  std::string rows = table_header();
  std::size_t written = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    rows += table_row(k + 1, bodies[k], files[k]);
    if (files[k].empty()) continue;
    work.write((folder / files[k]).string(), [&](const std::string& path, const Execution&) {
      write_mesh(bodies[k].mesh, path);
    });
    ++written;
  }
  write_file(table, rows);
  work.print({file.warnings.begin(), file.warnings.end()}, {summary_of(bodies, written)});
  return Done;
}

}  // namespace wscvt::program
