// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/mapped_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/solid_angle.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

constexpr std::size_t mapped_block = 8192;
constexpr std::size_t located_block = 1024;

[[noreturn]] void refuse_directions(const std::string& what) {
  refuse("The mesh is not spread over the sphere: " + what +
         " Use the directions that map_to_sphere returns for this mesh.");
}

}  // namespace

MappedSurface::MappedSurface(IndexedMesh mesh, std::vector<Vector3> directions,
                             const Execution& execution)
    : mesh_(std::move(mesh)),
      directions_(std::move(directions)),
      cube_(CubeMap::resolution_for(mesh_.triangles.size())) {
  const std::size_t vertices = mesh_.points.size();
  if (directions_.size() != vertices) {
    refuse_directions("it has " + std::to_string(vertices) + " vertices and " +
                      std::to_string(directions_.size()) + " directions.");
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    // Written so that a NaN fails.
    if (!(std::abs(directions_[i].squaredNorm() - 1.0) < 1e-9)) {
      refuse_directions("the direction of vertex " + std::to_string(i) + " is not a unit vector.");
    }
  }
  for (const Triangle& t : mesh_.triangles) {
    for (const std::int32_t v : t) {
      if (v < 0 || static_cast<std::size_t>(v) >= vertices) {
        refuse_directions("a face names the vertex " + std::to_string(v) + " of " +
                          std::to_string(vertices) + ".");
      }
    }
  }
  opposite_ = link_half_edges(mesh_.triangles, vertices).opposite;
  for (std::size_t h = 0; h < opposite_.size(); ++h) {
    if (opposite_[h] < 0 || opposite_[opposite_[h]] != static_cast<std::int32_t>(h)) {
      refuse_directions("it has a border at vertex " +
                        std::to_string(mesh_.triangles[h / 3][h % 3]) + ".");
    }
  }
  std::vector<std::int32_t> cells(mesh_.triangles.size());
  const double angles = execution.parallel_sum_of(
      mesh_.triangles.size(), mapped_block, 0.0, [&](std::size_t f, double& part) {
        const Triangle& t = mesh_.triangles[f];
        const Vector3& a = directions_[t[0]];
        const Vector3& b = directions_[t[1]];
        const Vector3& c = directions_[t[2]];
        if (!counter_clockwise(a, b, c)) {
          refuse_directions("face " + std::to_string(f) + " is inverted there.");
        }
        part += solid_angle(a, b, c);
        // The sum of a thin triangle's directions may be short, but it is never zero.
        cells[f] = static_cast<std::int32_t>(cube_.cell(a + b + c));
      });
  if (!(std::abs(angles / (4.0 * pi) - 1.0) < 1e-3)) {
    refuse_directions("its faces cover the sphere " +
                      std::to_string(std::lround(angles / (4.0 * pi))) + " times.");
  }
  starts_.assign(cube_.cells(), -1);
  for (std::size_t f = cells.size(); f-- > 0;) starts_[cells[f]] = static_cast<std::int32_t>(f);
  std::int32_t last = 0;
  for (std::int32_t& start : starts_) {
    if (start < 0) start = last;
    last = start;
  }
}

MeshPlace MappedSurface::locate(const Vector3& direction) const {
  const auto faces = static_cast<std::int32_t>(mesh_.triangles.size());
  std::int32_t f = starts_[cube_.cell(direction)];
  // A walk with a fixed order of edges could cycle on triangles that are not Delaunay. In random
  // order it ends with probability 1 (Devillers, Pion and Teillaud 2002, "Walking in a
  // triangulation"). The walk has its own random numbers, so that the result depends only on the
  // arguments.
  std::uint32_t random = 1;
  std::int32_t entered = -1;
  // A walk crosses about the square root of the number of triangles. If it is far longer, all
  // triangles are searched: exact signs guarantee that one contains the direction.
  const std::int64_t longest = 1000 + 20 * std::llround(std::sqrt(static_cast<double>(faces)));
  std::int64_t steps = 0;
  std::int32_t exhaustive = 0;
  for (;;) {
    const Triangle& t = mesh_.triangles[f];
    const std::array<const Vector3*, 3> corners{&directions_[t[0]], &directions_[t[1]],
                                                &directions_[t[2]]};
    random = random * 1664525U + 1013904223U;
    const auto first = static_cast<std::int32_t>((random >> 16U) % 3U);
    std::int32_t crossed = -1;
    for (std::int32_t j = 0; j < 3 && crossed < 0; ++j) {
      const std::int32_t k = (first + j) % 3;
      if (3 * f + k == entered) continue;  // the direction is known to be on this side of it
      if (sphere_orientation(direction, *corners[k], *corners[(k + 1) % 3]) < 0) crossed = k;
    }
    if (crossed < 0) {
      Vector3 weights;
      for (std::int32_t k = 0; k < 3; ++k) {
        const Vector3& q = *corners[(k + 1) % 3];
        const Vector3& r = *corners[(k + 2) % 3];
        // Differences keep the relative precision of small triangles. The signs are known, so
        // values below zero are rounding errors.
        weights[k] = std::max(0.0, direction.dot(doubled_area_normal(direction, q, r)));
      }
      const double sum = weights.sum();
      if (sum > 0.0) return {f, weights / sum};
      return {f, Vector3::Constant(1.0 / 3.0)};
    }
    ++steps;
    if (steps < longest) {
      entered = opposite_[3 * f + crossed];
      f = entered / 3;
    } else {
      entered = -1;
      f = exhaustive++ % faces;
    }
  }
}

std::vector<Vector3> MappedSurface::positions(const std::vector<Vector3>& directions,
                                              const Execution& execution) const {
  std::vector<Vector3> points(directions.size());
  execution.parallel_for_each(points.size(), located_block,
                              [&](std::size_t i) { points[i] = position(locate(directions[i])); });
  return points;
}

}  // namespace wscvt
