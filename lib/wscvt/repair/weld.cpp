// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/sorting.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

using Cell = std::array<std::int64_t, 3>;

std::uint64_t hash_of(const Cell& cell) {
  std::uint64_t hash = 0;
  for (const std::int64_t coordinate : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  }
  return hash * 0xD6E8FEB86659FD93U;
}

/// Cubes of the box, to limit the search for the neighbours of a point.
struct Grid {
  Vector3 low;
  double cells_per_length;
  double reach;  ///< tolerance in cells, plus a margin for rounding

  /// Returns the position of a point, in cells.
  Eigen::Array3d position(const Vector3& point) const {
    return (point - low).array() * cells_per_length;
  }
};

Grid grid_of(const Box& box, double tolerance, std::size_t points) {
  // A cube's side is 64 tolerances, so that 9 points in 10 are more than a tolerance from the sides
  // of their cube, and one look-up finds all near points. It is at most the spacing of points
  // spread over the surface, else a cube would contain many points. It is at least 2^-36 of the
  // box, so that a double resolves positions to 2^-17 of a cube.
  const double extent = box.sizes().maxCoeff();
  const double spacing = extent / std::sqrt(static_cast<double>(points));
  const double size = std::max(std::min(64.0 * tolerance, std::max(spacing, 4.0 * tolerance)),
                               std::ldexp(extent, -36));
  if (!(size > 0.0)) return {box.min(), 0.0, 0.0};  // all points are equal
  return {box.min(), 1.0 / size, tolerance > 0.0 ? tolerance / size + 1e-4 : 0.0};
}

Cell cell_at(const Eigen::Array3d& position) {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) {
    cell[k] = static_cast<std::int64_t>(std::floor(position[static_cast<Eigen::Index>(k)]));
  }
  return cell;
}

}  // namespace

// A hash table of the kept points, with open addressing; the key is the cube of a point. The slow
// part, the cubes and their hashes, is computed in parallel beforehand. The table is filled in
// the order of the points, so that the result does not depend on threads. CGAL and MeshLab sort
// the points or use a map; both take three times as long and find only exact copies.
Weld find_equal_points(const std::vector<Vector3>& points, const Box& box, double tolerance,
                       const Execution& execution) {
  const std::size_t count = points.size();
  const Grid grid = grid_of(box, tolerance, count);
  unsigned bits = 2;
  while ((std::size_t{1} << bits) < 2 * count) ++bits;
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  const auto slot_of = [&](const Cell& cell) {
    return static_cast<std::uint32_t>(hash_of(cell) >> (64U - bits));
  };
  // For every point the slot of its cube (at most 31 bits), and these marks.
  constexpr std::uint32_t at_side = 1U << 31U;    // equal points may be in the next cubes
  constexpr std::uint32_t outside = 0xFFFFFFFFU;  // not compared
  std::vector<std::uint32_t> slots(count);
  execution.parallel_for_each(count, usual_block, [&](std::size_t i) {
    const Vector3& p = points[i];
    if (!box.contains(p)) {  // also NaN, which has no cell
      slots[i] = outside;
      return;
    }
    const Eigen::Array3d position = grid.position(p);
    const Eigen::Array3d within = position - position.floor();
    slots[i] = slot_of(cell_at(position));
    if ((within.min(1.0 - within) < grid.reach).any()) slots[i] |= at_side;
  });

  std::vector<std::int32_t> table(mask + 1, -1);
  // Returns the first point equal to point i in the slots from `slot` to the next free slot. If
  // there is none, returns -1 and sets `slot` to the free slot.
  const auto find = [&](std::size_t i, std::size_t& slot) {
    for (; table[slot] >= 0; slot = (slot + 1) & mask) {
      const Vector3& other = points[index(table[slot])];
      if ((other - points[i]).cwiseAbs().maxCoeff() <= tolerance) return table[slot];
    }
    return std::int32_t{-1};
  };
  const auto find_in_next_cells = [&](std::size_t i, std::int32_t found) {
    const Eigen::Array3d position = grid.position(points[i]);
    const Cell low = cell_at(position - grid.reach);
    const Cell high = cell_at(position + grid.reach);
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          std::size_t slot = slot_of({x, y, z});
          const std::int32_t other = find(i, slot);
          if (other >= 0 && (found < 0 || other < found)) found = other;
        }
      }
    }
    return found;
  };
  Weld weld;
  std::vector<std::int32_t>& first = weld.first;
  for (std::size_t i = 0; i < count; ++i) {
    std::int32_t found = -1;
    if (slots[i] != outside) {
      std::size_t slot = slots[i] & ~at_side;
      found = find(i, slot);
      if ((slots[i] & at_side) != 0) found = find_in_next_cells(i, found);
      if (found < 0) table[slot] = static_cast<std::int32_t>(i);
    }
    if (found < 0) {
      if (!first.empty()) first[i] = static_cast<std::int32_t>(i);
      continue;
    }
    if (first.empty()) {
      first.resize(count);
      for (std::size_t j = 0; j < i; ++j) first[j] = static_cast<std::int32_t>(j);
    }
    first[i] = found;
    ++weld.welded;
  }
  return weld;
}

SeamWeld find_seams(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings, double size,
                    const Execution& execution) {
  constexpr double largest_share = 1e-6;  // of the size; scans are ten times less exact
  SeamWeld result;
  std::vector<std::int32_t> ends;
  double length = 0.0;
  std::size_t open = 0;
  for (std::size_t h = 0; h < rings.size(); ++h) {
    if (index(rings[h]) != h) continue;
    const auto half_edge = static_cast<std::int32_t>(h);
    const std::int32_t a = origin_of(mesh.triangles, half_edge);
    const std::int32_t b = target_of(mesh.triangles, half_edge);
    ends.insert(ends.end(), {a, b});
    length += (mesh.points[index(a)] - mesh.points[index(b)]).norm();
    ++open;
  }
  if (open == 0) return result;
  sort_unique(ends);
  std::vector<Vector3> points;
  for (const std::int32_t v : ends) points.push_back(mesh.points[index(v)]);
  const double tolerance = std::min(largest_share * size, 0.1 * length / static_cast<double>(open));
  const Weld near = find_equal_points(points, box_of_faces(mesh), tolerance, execution);
  if (near.welded == 0) return result;
  std::vector<std::int32_t> first(mesh.points.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    first[index(ends[k])] = ends[index(near.first[k])];
    result.distance = std::max(result.distance, (points[index(near.first[k])] - points[k]).norm());
  }
  IndexedMesh merged;
  merged.points.resize(mesh.points.size());
  for (Triangle t : mesh.triangles) {
    for (std::int32_t& v : t) v = first[index(v)];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) merged.triangles.push_back(t);
  }
  const std::vector<std::int32_t> joined = edge_rings(merged, execution);
  std::size_t left = 0;
  for (std::size_t h = 0; h < joined.size(); ++h) left += index(joined[h]) == h ? 1U : 0U;
  if (2 * left > open) return {};
  result.weld = {std::move(first), near.welded};
  return result;
}

}  // namespace wscvt
