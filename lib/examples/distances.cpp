// SPDX-License-Identifier: GPL-3.0-or-later
// distances MESH REFERENCE: how far two meshes are apart, and the vertex of MESH that is farthest
// off.
#include <wscvt/measures/distances.h>
#include <wscvt/mesh_files/mesh_io.h>

#include <algorithm>
#include <exception>
#include <iostream>

int main(int count, char** arguments) try {
  if (count != 3) {
    std::cerr << "usage: distances MESH REFERENCE\n";
    return 2;
  }
  const wscvt::Execution all_threads;
  const wscvt::IndexedMesh mesh = wscvt::read_mesh(arguments[1]);
  const wscvt::IndexedMesh reference = wscvt::read_mesh(arguments[2]);
  const wscvt::MeshDistances apart =
      wscvt::measure_distances(mesh, reference, wscvt::usual_distance_samples, all_threads);
  std::cout << "two-sided rms " << apart.root_mean_square << ", largest " << apart.largest << '\n';

  // The same tree answers single points.
  const wscvt::MeshDistance to_reference(reference, all_threads);
  const std::vector<double> off = to_reference.distances(mesh.points, all_threads);
  const auto farthest = std::max_element(off.begin(), off.end()) - off.begin();
  std::cout << "vertex " << farthest << " at " << mesh.points[farthest].transpose() << " is "
            << off[farthest] << " off\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
