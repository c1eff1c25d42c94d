// SPDX-License-Identifier: GPL-3.0-or-later
// One line for each body that is mapped to the sphere: processor time, memory, triangles turned
// over and how far the map distorts. Bodies are the bent grains, a dense star-shaped one, and the
// scans named on the command line, whose handles are cut first.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "dense_grain.h"
#include "grains/bent_grain.h"
#include "wscvt/base/error.h"
#include "wscvt/scan/handles.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/scan/mesh_io.h"
#include "wscvt/sphere/orientation.h"
#include "wscvt/surface/mesh_collapse.h"
#include "wscvt/surface/sphere_map.h"

namespace wscvt {
namespace {

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// A line of /proc/self/status, bytes; 0 where there is no such file.
double status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.rfind(key, 0) != 0) continue;
    std::istringstream fields(line.substr(key.size() + 1));
    double kilobytes = 0.0;
    fields >> kilobytes;
    return 1024.0 * kilobytes;
  }
  return 0.0;
}

void print_line(const std::string& name, const IndexedMesh& mesh) {
  const Execution execution(1);
  const double vertices = static_cast<double>(mesh.points.size());
  double collapse_time = processor_seconds();
  {
    MeshCollapse collapse(mesh, execution);
    collapse.collapse_to(4, execution);
  }
  collapse_time = processor_seconds() - collapse_time;
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts anew
  const double before = status_bytes("VmRSS");
  double time = processor_seconds();
  const SphereMap map = map_to_sphere(mesh, SphereMapOptions{}, execution);
  time = processor_seconds() - time;
  const double bytes = (status_bytes("VmHWM") - before) / vertices;
  const auto turned =
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        return !counter_clockwise(map.directions[t[0]], map.directions[t[1]], map.directions[t[2]]);
      });
  std::printf("%-24s %9.0f %6ld %9.3f %9.3f %7.0f %8.3f %10.3g %9.3g %9.3f\n", name.c_str(),
              vertices, static_cast<long>(turned), collapse_time, time, bytes,
              map.report.mean_angle_distortion, map.report.smallest_area_ratio,
              map.report.largest_area_ratio, map.report.energy);
  std::fflush(stdout);
}

void run(const std::vector<int>& bent, const std::vector<int>& dense,
         const std::vector<std::string>& files) {
  std::printf("%-24s %9s %6s %9s %9s %7s %8s %10s %9s %9s\n", "body", "vertices", "turned",
              "collapse", "map (s)", "B/vert", "angle", "area min", "max", "energy");
  for (const int vertices : bent) {
    for (const test::BentGrain& grain : test::bent_grains()) {
      print_line(grain.name, test::bent_grain_mesh(grain, vertices));
    }
  }
  for (const int vertices : dense) print_line("sand", test::dense_grain(vertices));
  for (const std::string& file : files) {
    const std::string name = file.substr(file.find_last_of('/') + 1);
    try {
      const CheckedMesh checked = check_mesh(read_mesh(file), MeshCheckOptions(), Execution(1));
      const HandleFreeMesh mesh = remove_handles(checked.mesh, HandleOptions(), Execution(1));
      for (const CutHandle& cut : mesh.report.cut) {
        std::printf("%-24s handle of %d edges cut, length %.3g R\n", name.c_str(), cut.edges,
                    cut.length / checked.report.equivalent_radius);
      }
      print_line(name, mesh.mesh);
    } catch (const Error& error) {
      std::printf("%-24s refused: %s\n", name.c_str(), error.what());
    }
  }
}

}  // namespace
}  // namespace wscvt

int main(int argc, char** argv) {
  CLI::App app("Figures of the map to the sphere.");
  std::vector<int> bent;
  std::vector<int> dense;
  std::vector<std::string> files;
  app.add_option("--bent", bent, "Vertices of the bent grains, several sizes at will");
  app.add_option("--dense", dense, "Vertices of a dense star-shaped grain");
  app.add_option("scans", files, "Meshes to map");
  CLI11_PARSE(app, argc, argv);
  wscvt::run(bent, dense, files);
  return 0;
}
