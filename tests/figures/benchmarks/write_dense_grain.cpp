// SPDX-License-Identifier: GPL-3.0-or-later
// write_dense_grain VERTICES OUT.ply: the large input of the timing comparison.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "dense_grain.h"
#include "wscvt/mesh_files/mesh_io.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: write_dense_grain VERTICES OUT.ply\n");
    return 2;
  }
  try {
    wscvt::write_mesh(wscvt::test::dense_grain(std::atoi(argv[1])), argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
