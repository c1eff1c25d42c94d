// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/stray_vertex.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/sorting.h"

namespace wscvt {

namespace {

/// The number of corners that are asked for the size of a mesh.
constexpr std::size_t most_asked = 3000;

/// Returns the median of the distance of the vertices from their middle.
double usual_distance(const IndexedMesh& mesh) {
  const std::size_t stride = 1 + mesh.triangles.size() / most_asked;
  std::vector<Vector3> asked;
  for (std::size_t f = 0; f < mesh.triangles.size(); f += stride) {
    asked.push_back(mesh.points[index(mesh.triangles[f][f % 3])]);
  }
  Vector3 middle;
  std::vector<double> values(asked.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < asked.size(); ++k) values[k] = asked[k][axis];
    middle[axis] = upper_median(values);
  }
  for (std::size_t k = 0; k < asked.size(); ++k) values[k] = (asked[k] - middle).norm();
  return upper_median(values);
}

/// A vertex with the faces about its place.
struct Corner {
  Vector3 place;
  std::int32_t vertex;
  double nearest = std::numeric_limits<double>::infinity();  ///< distance of a neighbour
  double around = 0.0;                                       ///< length of the edges opposite to it

  bool operator<(const Corner& other) const {
    const auto order = [](const Vector3& a, const Vector3& b) {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    };
    return place == other.place ? vertex < other.vertex : order(place, other.place);
  }
};

/// Returns the corners of faces on which they lie farther than `least` from the others, one for
/// each place, in ascending order.
std::vector<Corner> far_corners(const IndexedMesh& mesh, double least) {
  const auto between = [&](std::int32_t v, std::int32_t w) {
    return (mesh.points[index(v)] - mesh.points[index(w)]).norm();
  };
  std::vector<Corner> far;
  for (const Triangle& t : mesh.triangles) {
    const std::array<double, 3> edges = {between(t[0], t[1]), between(t[1], t[2]),
                                         between(t[2], t[0])};
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::min(edges[k], edges[preceding(k)]) > least) {
        far.push_back({mesh.points[index(t[k])], t[k]});
      }
    }
  }
  std::sort(far.begin(), far.end());
  far.erase(std::unique(far.begin(), far.end(),
                        [](const Corner& a, const Corner& b) { return a.place == b.place; }),
            far.end());
  if (far.empty()) return far;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      // Faces that are not welded have vertices of their own at a place.
      const auto at =
          std::lower_bound(far.begin(), far.end(), Corner{mesh.points[index(t[k])], -1});
      if (at == far.end() || at->place != mesh.points[index(t[k])]) continue;
      at->nearest =
          std::min({at->nearest, between(t[k], t[following(k)]), between(t[k], t[preceding(k)])});
      at->around += between(t[following(k)], t[preceding(k)]);
    }
  }
  return far;
}

}  // namespace

StrayVertex find_stray_vertex(const IndexedMesh& mesh) {
  // 1 for a ball; 10 for the tip of a cone 5 times as high as wide whose side has no other vertex.
  constexpr double farthest = 5.0;
  constexpr double least = 0.25;
  constexpr double narrow = 2.0;  // 1.6 for this tip
  StrayVertex stray;
  stray.usual = usual_distance(mesh);
  if (!(stray.usual > 0.0)) return stray;
  for (const Corner& corner : far_corners(mesh, least * stray.usual)) {
    const bool is_far = corner.nearest > farthest * stray.usual;
    const bool is_spike =
        corner.nearest > least * stray.usual && corner.nearest > narrow * corner.around;
    if (!is_far && !is_spike) continue;
    ++stray.count;
    if (!(corner.nearest > stray.distance)) continue;
    stray.distance = corner.nearest;
    stray.vertex = index(corner.vertex);
    stray.place = corner.place;
  }
  return stray;
}

}  // namespace wscvt
