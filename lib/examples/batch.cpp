// SPDX-License-Identifier: GPL-3.0-or-later
// batch OUTPUT_FOLDER SCAN...: remeshes scans to 500 nodes each and appends a row a grain to a
// table. A grain that is refused costs its own row only. `wscvt batch` does more: it resumes and
// shards.
#include <wscvt/base/error.h>
#include <wscvt/mesh_files/mesh_io.h>
#include <wscvt/remesh.h>
#include <wscvt/report/report.h>

#include <exception>
#include <filesystem>
#include <iostream>

int main(int count, char** arguments) {
  if (count < 3) {
    std::cerr << "usage: batch OUTPUT_FOLDER SCAN...\n";
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  wscvt::RemeshOptions options;
  options.node_count = 500;
  const wscvt::Execution all_threads;
  int refused = 0;
  for (int i = 2; i < count; ++i) {
    const std::filesystem::path scan = arguments[i];
    try {
      const wscvt::RemeshResult result =
          wscvt::remesh(wscvt::read_mesh(scan.string()), options, all_threads);
      const std::filesystem::path mesh = folder / scan.filename().replace_extension(".ply");
      wscvt::write_mesh(result.mesh, mesh.string());
      wscvt::write_report((folder / "grains.csv").string(), result, {scan.filename().string(), ""},
                          all_threads);
      std::cout << scan.filename().string() << ": sphericity " << result.scan.sphericity
                << ", of the remesh " << result.remesh.sphericity << '\n';
    } catch (const std::exception& error) {
      std::cerr << scan.string() << ": " << error.what() << '\n';
      ++refused;
    }
  }
  return refused == 0 ? 0 : 1;
}
