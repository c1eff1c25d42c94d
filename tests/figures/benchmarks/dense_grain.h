// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "grains/ct_grain.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt::test {

/// A sand grain with any number of vertices, from 4 to millions: its formula on a Fibonacci
/// lattice, with scanner noise of a tenth of the spacing. Cheaper to make than a simulated scan of
/// that size, and as closed and uneven to the remesher.
inline IndexedMesh dense_grain(int vertices) {
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
