// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/single_precision.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wscvt {

double sampled_mean_edge(const IndexedMesh& mesh) {
  constexpr std::size_t most = 10000;
  const std::size_t stride = 1 + mesh.triangles.size() / most;
  double sum = 0.0;
  double edges = 0.0;
  for (std::size_t f = 0; f < mesh.triangles.size(); f += stride) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      sum += (mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm();
      edges += 1.0;
    }
  }
  return edges > 0.0 ? sum / edges : 0.0;
}

double single_precision_step(const IndexedMesh& mesh) {
  const double edge = sampled_mean_edge(mesh);
  if (!(edge > 0.0) || !std::isfinite(edge)) return 0.0;
  double largest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) {
      largest = std::max(largest, mesh.points[v].cwiseAbs().maxCoeff());
    }
  }
  // Floats have 24 binary digits.
  return std::ldexp(1.0, std::ilogb(largest) - 23) / edge;
}

}  // namespace wscvt
