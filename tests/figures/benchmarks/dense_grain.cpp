// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense_grain.h"

#include <cmath>

#include "grains/ct_grain.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt::test {

IndexedMesh dense_grain(int vertices) {
  IndexedMesh mesh;
  mesh.points = fibonacci_lattice(vertices);
  mesh.triangles = SphereTriangulation(mesh.points).triangles();
  const std::vector<double> radii = sand_grain(11).radii(mesh.points);
  const std::vector<Vector3> noise = random_directions(vertices, 3);
  const double amplitude = 0.1 * std::sqrt(12.566 / vertices);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    mesh.points[i] *= radii[i] * (1.0 + amplitude * noise[i].z());
  }
  return mesh;
}

}  // namespace wscvt::test
