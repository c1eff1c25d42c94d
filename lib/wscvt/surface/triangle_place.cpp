// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/triangle_place.h"

namespace wscvt {

TrianglePlace walk_to_nearest(const Vector3& p, const EditMesh& mesh, std::int32_t& t) {
  return walk_to_nearest(p, mesh, t, nearest_in_triangle(p, mesh, t));
}

TrianglePlace walk_to_nearest(const Vector3& p, const EditMesh& mesh, std::int32_t& t,
                              TrianglePlace place) {
  // Each step is nearer by more than rounding, so a walk never returns; the limit is a safeguard
  // only.
  constexpr int most_steps = 10000;
  constexpr double rounding = 1e-12;
  for (int step = 0; step < most_steps && place.region != 0; ++step) {
    std::int32_t nearest = -1;
    double limit = place.squared_distance * (1.0 - rounding);
    TrianglePlace better;
    const auto look = [&](std::int32_t u) {
      const TrianglePlace other = nearest_in_triangle(p, mesh, u);
      if (other.squared_distance >= limit) return;
      limit = other.squared_distance;
      better = other;
      nearest = u;
    };
    if (place.region <= 3) {
      look(static_cast<std::int32_t>(
          face_of(mesh.opposite[3 * t + static_cast<std::int32_t>(following(place.region - 1))])));
    } else {
      const std::int32_t start = 3 * t + place.region - 4;
      for (std::int32_t h = mesh.opposite[previous_half_edge(start)]; h != start;
           h = mesh.opposite[previous_half_edge(h)]) {
        look(static_cast<std::int32_t>(face_of(h)));
      }
    }
    if (nearest < 0) break;
    t = nearest;
    place = better;
  }
  return place;
}

}  // namespace wscvt
