// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes scans of the bodies that no ray from one centre describes, for the table of the study:
// write_bent_grains FOLDER [VERTICES].

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "grains/bent_grain.h"
#include "wscvt/scan/mesh_io.h"

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "Usage: write_bent_grains FOLDER [VERTICES]\n");
    return 2;
  }
  try {
    const int vertices = argc == 3 ? std::stoi(argv[2]) : 15000;
    std::filesystem::create_directories(argv[1]);
    for (const wscvt::test::BentGrain& grain : wscvt::test::bent_grains()) {
      wscvt::write_mesh(wscvt::test::bent_grain_mesh(grain, vertices),
                        (std::filesystem::path(argv[1]) / (grain.name + ".ply")).string());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
