// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/step_guard.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "wscvt/base/pi.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t step_block = 256;

/// Of a step; a node that is held back beyond takes none, since less than a sixteenth is not worth
/// another look at all triangles.
constexpr int most_halvings = 4;

}  // namespace

GuardedSteps::GuardedSteps(const IndexedMesh& nodes, const HalfEdges& half_edges,
                           std::vector<Vector3> steps, const StepLimits& limits,
                           const Execution& execution)
    : nodes_(nodes),
      half_edges_(half_edges),
      execution_(execution),
      steps_(std::move(steps)),
      halvings_(nodes.points.size(), 0),
      angle_cosine_(std::cos(limits.smallest_angle * pi / 180.0)),
      turn_cosine_(std::cos(limits.largest_turn * pi / 180.0)),
      before_(shape_of(nodes.points)) {}

std::vector<Vector3> GuardedSteps::positions() {
  const std::vector<Triangle>& triangles = nodes_.triangles;
  while (true) {
    std::vector<Vector3> positions = nodes_.points;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (halvings_[i] > most_halvings) continue;
      positions[i] += std::ldexp(1.0, -halvings_[i]) * steps_[i];
    }
    bool held = false;
    const Shape shape = shape_of(positions);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (shape.angles[t] <= std::max(angle_cosine_, before_.angles[t])) continue;
      for (const std::int32_t v : triangles[t]) held |= hold_back(v);
    }
    for (std::size_t h = 0; h < shape.turns.size(); ++h) {
      if (shape.turns[h] >= std::min(turn_cosine_, before_.turns[h])) continue;
      for (const std::int32_t v : triangles[h / 3]) held |= hold_back(v);
    }
    if (!held) return positions;
  }
}

bool GuardedSteps::hold_back(std::int32_t node) {
  if (halvings_[node] > most_halvings) return false;
  ++halvings_[node];
  return true;
}

int GuardedSteps::held_back() const {
  return static_cast<int>(
      std::count_if(halvings_.begin(), halvings_.end(), [](int halved) { return halved > 0; }));
}

GuardedSteps::Shape GuardedSteps::shape_of(const std::vector<Vector3>& points) const {
  const std::vector<Triangle>& triangles = nodes_.triangles;
  Shape shape;
  shape.angles.resize(triangles.size());
  shape.turns.resize(3 * triangles.size());
  std::vector<Vector3> normals(triangles.size());
  execution_.parallel_for(triangles.size(), step_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = triangles[t];
      shape.angles[t] = largest_corner_cosine(points[a], points[b], points[c]);
      normals[t] = doubled_area_normal(points[a], points[b], points[c]).normalized();
    }
  });
  for (std::size_t h = 0; h < shape.turns.size(); ++h) {
    shape.turns[h] = normals[h / 3].dot(normals[half_edges_.opposite[h] / 3]);
  }
  return shape;
}

}  // namespace wscvt
