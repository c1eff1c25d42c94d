// SPDX-License-Identifier: GPL-3.0-or-later

// Makes the grains of this folder: make_samples FOLDER writes them there, byte for byte as
// committed.

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>

#include "grains/ct_grain.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace {

using wscvt::IndexedMesh;
using wscvt::test::CtOptions;
using wscvt::test::Grain;

/// A scan of exactly `vertices` vertices: the voxel size is brought near, then the grid is shifted
/// until the number is met. `blur` is that of the scanner.
IndexedMesh exact_count(const Grain& grain, std::size_t vertices, double blur) {
  CtOptions options;
  options.blur = blur;
  std::mt19937_64 engine(vertices);
  const auto target = static_cast<double>(vertices);
  for (int attempt = 0; attempt < 4000; ++attempt) {
    IndexedMesh mesh = wscvt::test::ct_mesh(grain, options);
    if (mesh.points.size() == vertices) return mesh;
    const double ratio = static_cast<double>(mesh.points.size()) / target;
    options.voxel *= 1.0 + 0.5 * (ratio - 1.0);
    for (double& shift : options.offset) shift = static_cast<double>(engine() % 1000) / 1000.0;
    ++options.seed;
  }
  throw std::runtime_error("no scan of " + grain.name + " has the number of vertices asked for");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_samples FOLDER\n";
    return EXIT_FAILURE;
  }
  try {
    const std::string folder = argv[1];
    // Texture that voxels blur away would be none; of the rough grain there is enough either way.
    constexpr double sharp = 0.4;
    constexpr double soft = 0.7;
    const struct {
      const char* file;
      Grain grain;
      std::size_t vertices;
      double blur;
    } samples[] = {{"sand_7228.ply", wscvt::test::textured_sand_grain(5), 7228, sharp},
                   {"sand_5658.ply", wscvt::test::textured_sand_grain(12), 5658, sharp},
                   {"angular_6000.ply", wscvt::test::textured_angular_grain(7), 6000, sharp},
                   {"elongated_rough_8000.ply", wscvt::test::rough_grain(23), 8000, soft}};
    for (const auto& sample : samples) {
      const IndexedMesh mesh = exact_count(sample.grain, sample.vertices, sample.blur);
      wscvt::write_mesh(mesh, folder + "/" + sample.file, wscvt::PlyCoordinates::Float);
      std::cout << sample.file << ": " << mesh.points.size() << " vertices, "
                << mesh.triangles.size() << " faces\n";
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
