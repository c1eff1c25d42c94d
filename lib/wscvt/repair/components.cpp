// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/components.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/sets.h"

namespace wscvt {

namespace {

/// Whether every edge has two faces, with consistent orientation.
bool is_closed_and_oriented(const std::vector<Triangle>& triangles,
                            const std::vector<std::int32_t>& rings, const Execution& execution) {
  const std::size_t others = execution.parallel_sum(
      triangles.size(), usual_block, std::size_t{0}, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = 3 * begin; h < 3 * end; ++h) {
          const auto half_edge = static_cast<std::int32_t>(h);
          const std::int32_t other = rings[h];
          // As in the walk below.
          if (other == half_edge || rings[index(other)] != half_edge ||
              triangles[h / 3][h % 3] == triangles[face_of(other)][corner_of(other)]) {
            return std::size_t{1};
          }
        }
        return std::size_t{0};
      });
  return others == 0;
}

/// Finds the parts of a mesh with only such edges, as scanners write it. No face needs turning, so
/// faces are joined in the order of the file. A walk waits for memory at every step: for a million
/// vertices, this function takes two fifths of its time.
void join_faces(const std::vector<std::int32_t>& rings, Components& result) {
  Sets parts(rings.size() / 3);
  for (std::size_t h = 0; h < rings.size(); ++h) {
    if (h < index(rings[h])) parts.unite(h / 3, face_of(rings[h]));
  }
  std::size_t count = 0;
  std::tie(result.of_face, count) = parts.numbers();
  result.list.resize(count);
  for (const std::int32_t part : result.of_face) ++result.list[index(part)].faces;
}

/// Finds the parts of any mesh.
void walk_faces(const std::vector<Triangle>& triangles, const std::vector<std::int32_t>& rings,
                Components& result) {
  // One walk finds the part and turns its faces, because both need every edge once. `stack`
  // contains faces with known part and turn and unvisited neighbours.
  std::vector<std::int32_t> stack;
  for (std::size_t start = 0; start < triangles.size(); ++start) {
    if (result.of_face[start] >= 0) continue;
    Component component;
    const auto number = static_cast<std::int32_t>(result.list.size());
    result.of_face[start] = number;
    stack.push_back(static_cast<std::int32_t>(start));
    while (!stack.empty()) {
      const std::size_t f = index(stack.back());
      stack.pop_back();
      ++component.faces;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto h = static_cast<std::int32_t>(3 * f + k);
        const std::int32_t other = rings[index(h)];
        if (other == h) {
          ++component.boundary_edges;
          continue;
        }
        const std::size_t g = face_of(other);
        const bool manifold = rings[index(other)] == h;
        // Consistently oriented faces use their edge in opposite directions.
        const bool same_way = triangles[f][k] == triangles[g][corner_of(other)];
        // If more faces meet, it is unknown which belong together; they keep their orientation.
        const bool turn = (manifold && same_way) != (result.turned[f] != 0);
        if (result.of_face[g] < 0) {
          result.of_face[g] = number;
          result.turned[g] = static_cast<char>(turn);
          stack.push_back(static_cast<std::int32_t>(g));
        } else if (manifold && turn != (result.turned[g] != 0)) {
          component.orientable = false;
        }
        if (!manifold && other < h) ++component.non_manifold_edges;  // the ring's last
      }
    }
    result.list.push_back(component);
  }
}

}  // namespace

Components find_components(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                           const Execution& execution) {
  const std::vector<Triangle>& triangles = mesh.triangles;
  Components result;
  result.of_face.assign(triangles.size(), -1);
  result.turned.assign(triangles.size(), 0);
  if (is_closed_and_oriented(triangles, rings, execution)) {
    join_faces(rings, result);
  } else {
    walk_faces(triangles, rings, result);
  }

  // Each component is measured about its own point, so that a grain far from the origin keeps its
  // digits. `origin` is this point: the first corner of the component's first face.
  std::vector<std::int32_t> origin(result.list.size(), -1);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    const std::size_t c = index(result.of_face[f]);
    if (origin[c] < 0) origin[c] = t[0];
    const Vector3& o = mesh.points[index(origin[c])];
    const auto [p, q, r] = corners_of(mesh, t);
    const double volume = six_volumes(p - o, q - o, r - o) / 6.0;
    result.list[c].volume += result.turned[f] ? -volume : volume;
  }
  return result;
}

void keep_faces(IndexedMesh& mesh, const Components& components, std::size_t kept) {
  std::size_t faces = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (index(components.of_face[f]) == kept) mesh.triangles[faces++] = mesh.triangles[f];
  }
  mesh.triangles.resize(faces);
}

std::size_t keep_component(IndexedMesh& mesh, const Components& components, std::size_t kept) {
  std::size_t turned = 0;
  const bool inside_out = components.list[kept].volume < 0.0;
  std::size_t faces = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (index(components.of_face[f]) != kept) continue;
    Triangle t = mesh.triangles[f];
    if ((components.turned[f] != 0) != inside_out) {
      std::swap(t[1], t[2]);
      ++turned;
    }
    mesh.triangles[faces++] = t;
  }
  mesh.triangles.resize(faces);
  drop_unused_points(mesh);
  return turned;
}

namespace {

/// Returns 1 if the projection of edge a b to the plane z = 0 passes above the point (in y) to the
/// right, -1 if to the left, 0 if it does not pass. It is computed from the lower vertex, so both
/// faces of an edge get equal results with opposite signs. For any rounding, each face over a point
/// is counted exactly once.
int passing(const IndexedMesh& mesh, std::int32_t a, std::int32_t b, const Vector3& point) {
  const Vector3& p = mesh.points[index(std::min(a, b))];
  const Vector3& q = mesh.points[index(std::max(a, b))];
  if ((p.x() <= point.x()) == (q.x() <= point.x())) return 0;
  const double share = (point.x() - p.x()) / (q.x() - p.x());
  if (!(p.y() + share * (q.y() - p.y()) > point.y())) return 0;
  return (q.x() > p.x()) == (a < b) ? 1 : -1;
}

}  // namespace

std::vector<char> are_inside(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                             const Execution& execution) {
  // Sorted by x, so that a face finds the points below and above it without testing all.
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return points[i].x() < points[j].x(); });
  struct Windings {
    std::vector<int> of_point;
    Windings& operator+=(const Windings& other) {
      for (std::size_t i = 0; i < of_point.size(); ++i) of_point[i] += other.of_point[i];
      return *this;
    }
  };
  // Each block has a list of all points. Use few blocks, so that many points need no more memory
  // than a mesh.
  const std::size_t block = std::max(usual_block, (mesh.triangles.size() + 15) / 16);
  const Windings windings = execution.parallel_sum_of(
      mesh.triangles.size(), block, Windings{std::vector<int>(points.size(), 0)},
      [&](std::size_t f, Windings& part) {
        const Triangle& t = mesh.triangles[f];
        const auto [a, b, c] = corners_of(mesh, t);
        const double low = std::min({a.x(), b.x(), c.x()});
        const double high = std::max({a.x(), b.x(), c.x()});
        const auto from =
            std::lower_bound(order.begin(), order.end(), low,
                             [&](std::size_t i, double x) { return points[i].x() < x; });
        for (auto at = from; at != order.end() && points[*at].x() <= high; ++at) {
          const Vector3& p = points[*at];
          int covers = 0;
          for (std::size_t k = 0; k < 3; ++k) covers += passing(mesh, t[k], t[following(k)], p);
          if (covers == 0) continue;
          const Vector3 normal = doubled_area_normal(a, b, c);
          // The face is above the point if the point is on its lower side.
          const double side = normal.dot(p - a) * (normal.z() > 0.0 ? 1.0 : -1.0);
          if (side < 0.0) part.of_point[*at] += covers;
        }
      });
  std::vector<char> inside(points.size());
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = windings.of_point[i] != 0 ? 1 : 0;
  return inside;
}

}  // namespace wscvt
