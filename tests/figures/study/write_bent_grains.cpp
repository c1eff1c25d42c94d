// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes scans of the bodies that no ray from one centre describes, for the table of the study:
// write_bent_grains FOLDER [VERTICES [COPIES]]. With COPIES each body is written so many times,
// stretched and bent at random: a sample for wscvt grow.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "grains/bent_grain.h"
#include "toolbox/sample/random_stream.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace {

/// Lengths change by a fifth along each axis, and the body by a tenth of a unit in between.
wscvt::IndexedMesh changed(wscvt::IndexedMesh mesh, std::uint64_t copy) {
  wscvt::RandomStream random(1, copy);
  wscvt::Vector3 stretch, phase;
  for (int axis = 0; axis < 3; ++axis) {
    stretch[axis] = std::exp(0.2 * random.normal());
    phase[axis] = random.uniform(0.0, 6.3);
  }
  for (wscvt::Vector3& p : mesh.points) {
    const wscvt::Vector3 wave(std::sin(1.5 * p.y() + phase.x()), std::sin(1.5 * p.z() + phase.y()),
                              std::sin(1.5 * p.x() + phase.z()));
    p = (p + 0.12 * wave).cwiseProduct(stretch);
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fprintf(stderr, "Usage: write_bent_grains FOLDER [VERTICES [COPIES]]\n");
    return 2;
  }
  try {
    const int vertices = argc > 2 ? std::stoi(argv[2]) : 15000;
    std::filesystem::create_directories(argv[1]);
    const int copies = argc > 3 ? std::stoi(argv[3]) : 0;
    std::uint64_t number = 0;
    for (const wscvt::test::BentGrain& grain : wscvt::test::bent_grains()) {
      const wscvt::IndexedMesh mesh = wscvt::test::bent_grain_mesh(grain, vertices);
      const std::filesystem::path folder(argv[1]);
      if (copies == 0) wscvt::write_mesh(mesh, (folder / (grain.name + ".ply")).string());
      for (int copy = 0; copy < copies; ++copy) {
        const std::string name = grain.name + "_" + std::to_string(copy) + ".ply";
        wscvt::write_mesh(changed(mesh, number++), (folder / name).string());
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
