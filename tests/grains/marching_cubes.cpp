// SPDX-License-Identifier: GPL-3.0-or-later
#include "marching_cubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace wscvt::test {

namespace {

// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2 & 1); edge 4 a + i runs along axis a from
// the i-th corner that has no bit a.
struct CellEdge {
  int low = 0;  ///< corner it starts from
  int axis = 0;
};

constexpr int edge_count = 12;
constexpr int centre = edge_count;  ///< name of the vertex in the middle of a cell

int corner_bit(int axis) { return 1 << axis; }

std::array<CellEdge, edge_count> cell_edges() {
  std::array<CellEdge, edge_count> edges;
  std::size_t number = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 8; ++corner) {
      if ((corner & corner_bit(axis)) == 0) edges[number++] = {corner, axis};
    }
  }
  return edges;
}

int edge_between(const std::array<CellEdge, edge_count>& edges, int a, int b) {
  for (int e = 0; e < edge_count; ++e) {
    const CellEdge& edge = edges[static_cast<std::size_t>(e)];
    if (edge.low == std::min(a, b) && (edge.low | corner_bit(edge.axis)) == std::max(a, b))
      return e;
  }
  return -1;
}

/// The corners of the six faces, counter-clockwise seen from outside the cell.
std::array<std::array<int, 4>, 6> cell_faces() {
  std::array<std::array<int, 4>, 6> faces{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto face = 2 * static_cast<std::size_t>(axis);
    const int u = corner_bit((axis + 1) % 3);
    const int v = corner_bit((axis + 2) % 3);
    const int high = corner_bit(axis);
    faces[face] = {0, v, u | v, u};
    faces[face + 1] = {high, high | u, high | u | v, high | v};
  }
  return faces;
}

bool share_face(const CellEdge& a, const CellEdge& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool in_face = a.axis != axis && b.axis != axis;
    if (in_face && (a.low & corner_bit(axis)) == (b.low & corner_bit(axis))) return true;
  }
  return false;
}

/// Cuts loop[first..last] off along first-last; false when every way needs a diagonal in a face.
bool triangulate(const std::array<CellEdge, edge_count>& edges, const std::vector<int>& loop,
                 std::size_t first, std::size_t last, std::vector<std::array<int, 3>>& triangles) {
  if (last - first < 2) return true;
  const auto allowed = [&](std::size_t i, std::size_t j) {
    if (j - i == 1 || (i == 0 && j == loop.size() - 1)) return true;  // a side of the loop
    return !share_face(edges[static_cast<std::size_t>(loop[i])],
                       edges[static_cast<std::size_t>(loop[j])]);
  };
  for (std::size_t middle = first + 1; middle < last; ++middle) {
    if (!allowed(first, middle) || !allowed(middle, last)) continue;
    const std::size_t before = triangles.size();
    triangles.push_back({loop[first], loop[middle], loop[last]});
    if (triangulate(edges, loop, first, middle, triangles) &&
        triangulate(edges, loop, middle, last, triangles)) {
      return true;
    }
    triangles.resize(before);
  }
  return false;
}

using CaseTable = std::array<std::vector<std::array<int, 3>>, 256>;

/// Triangles of every pattern of high corners, as edges of the cell (or its centre).
CaseTable make_cases() {
  const std::array<CellEdge, edge_count> edges = cell_edges();
  CaseTable cases;
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    const auto high = [&](int corner) {
      return (pattern >> static_cast<unsigned>(corner) & 1U) != 0;
    };
    // Where the surface runs on from each crossed edge. On a face, seen from outside, it keeps the
    // high corners on its right: from where the boundary, counter-clockwise, enters a run of them
    // to where it leaves it.
    std::array<int, edge_count> next{};
    next.fill(-1);
    for (const std::array<int, 4>& face : cell_faces()) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (!high(face[i]) || high(face[(i + 1) % 4])) continue;
        std::size_t j = i;
        while (high(face[(j + 3) % 4])) j = (j + 3) % 4;
        const int leaving = edge_between(edges, face[i], face[(i + 1) % 4]);
        const int entering = edge_between(edges, face[(j + 3) % 4], face[j]);
        next[static_cast<std::size_t>(entering)] = leaving;
      }
    }
    std::array<bool, edge_count> done{};
    for (int start = 0; start < edge_count; ++start) {
      if (next[static_cast<std::size_t>(start)] < 0 || done[static_cast<std::size_t>(start)])
        continue;
      std::vector<int> loop;
      for (int e = start; !done[static_cast<std::size_t>(e)];
           e = next[static_cast<std::size_t>(e)]) {
        done[static_cast<std::size_t>(e)] = true;
        loop.push_back(e);
      }
      std::vector<std::array<int, 3>>& triangles = cases[pattern];
      if (!triangulate(edges, loop, 0, loop.size() - 1, triangles)) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
          triangles.push_back({loop[i], loop[(i + 1) % loop.size()], centre});
        }
      }
    }
  }
  return cases;
}

}  // namespace

IndexedMesh marching_cubes(const VoxelGrid& grid, double level) {
  static const CaseTable cases = make_cases();
  static const std::array<CellEdge, edge_count> edges = cell_edges();
  IndexedMesh mesh;
  // The vertex on the edge that leaves each node along each axis.
  std::vector<std::array<std::int32_t, 3>> vertices(grid.values.size(), {-1, -1, -1});
  const auto position = [&](int x, int y, int z) {
    return Vector3(grid.origin + grid.spacing * Vector3(x, y, z));
  };
  for (int z = 0; z + 1 < grid.size[2]; ++z) {
    for (int y = 0; y + 1 < grid.size[1]; ++y) {
      for (int x = 0; x + 1 < grid.size[0]; ++x) {
        const auto node = [&](int corner) {
          return grid.index(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2 & 1));
        };
        unsigned pattern = 0;
        for (int corner = 0; corner < 8; ++corner) {
          if (grid.values[node(corner)] > level) pattern |= 1U << static_cast<unsigned>(corner);
        }
        std::int32_t centre_vertex = -1;
        const auto vertex = [&](int name) {
          if (name == centre) {
            if (centre_vertex < 0) {
              centre_vertex = static_cast<std::int32_t>(mesh.points.size());
              mesh.points.emplace_back(position(x, y, z) + Vector3::Constant(0.5 * grid.spacing));
            }
            return centre_vertex;
          }
          const CellEdge& edge = edges[static_cast<std::size_t>(name)];
          std::int32_t& number = vertices[node(edge.low)][static_cast<std::size_t>(edge.axis)];
          if (number < 0) {
            number = static_cast<std::int32_t>(mesh.points.size());
            const double a = grid.values[node(edge.low)];
            const double b = grid.values[node(edge.low | corner_bit(edge.axis))];
            Vector3 p =
                position(x + (edge.low & 1), y + (edge.low >> 1 & 1), z + (edge.low >> 2 & 1));
            p[edge.axis] += grid.spacing * (level - a) / (b - a);
            mesh.points.push_back(p);
          }
          return number;
        };
        for (const std::array<int, 3>& t : cases[pattern]) {
          mesh.triangles.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
        }
      }
    }
  }
  return mesh;
}

void blur(VoxelGrid& grid, double deviation) {
  const int reach = static_cast<int>(std::ceil(4.0 * deviation));
  std::vector<double> kernel;
  for (int i = -reach; i <= reach; ++i) {
    kernel.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
  }
  const double total = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& k : kernel) k /= total;
  const double* const middle = kernel.data() + reach;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> source = grid.values;
    for (int z = 0; z < grid.size[2]; ++z) {
      for (int y = 0; y < grid.size[1]; ++y) {
        for (int x = 0; x < grid.size[0]; ++x) {
          double sum = 0.0;
          for (int i = -reach; i <= reach; ++i) {
            std::array<int, 3> at{x, y, z};
            at[axis] = std::clamp(at[axis] + i, 0, grid.size[axis] - 1);
            sum += middle[i] * source[grid.index(at[0], at[1], at[2])];
          }
          grid.values[grid.index(x, y, z)] = sum;
        }
      }
    }
  }
}

}  // namespace wscvt::test
