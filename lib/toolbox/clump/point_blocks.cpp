// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/point_blocks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace wscvt {

PointBlocks::PointBlocks(std::vector<Vector3> points) : points_(std::move(points)) {
  split(0, points_.size());
}

void PointBlocks::split(std::size_t begin, std::size_t end) {
  constexpr std::size_t most = 32;
  if (begin == end) return;
  const auto at = [this](std::size_t i) {
    return points_.begin() + static_cast<std::ptrdiff_t>(i);
  };
  Vector3 low = points_[begin];
  Vector3 high = low;
  for (auto p = at(begin); p != at(end); ++p) {
    low = low.cwiseMin(*p);
    high = high.cwiseMax(*p);
  }
  if (end - begin <= most) {
    PointBlock block{begin, end, 0.5 * (low + high), 0.0};
    for (auto p = at(begin); p != at(end); ++p) {
      block.radius = std::max(block.radius, (*p - block.centre).norm());
    }
    // Bound of the rounding in a distance to the block.
    constexpr double slack = 1e-12;
    block.radius += slack * (high - low).norm();
    blocks_.push_back(block);
    return;
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  // Sorted by all coordinates: a partial order would depend on the library.
  std::sort(at(begin), at(end), [axis](const Vector3& a, const Vector3& b) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    return std::array{a[axis], a[next], a[last]} < std::array{b[axis], b[next], b[last]};
  });
  const std::size_t middle = begin + (end - begin) / 2;
  split(begin, middle);
  split(middle, end);
}

std::size_t PointBlocks::nearest(const Vector3& to) const {
  const auto reach = [&](const PointBlock& block) {
    return (block.centre - to).norm() - block.radius;
  };
  // Starts with the most likely block, so that few others remain.
  const PointBlock* first = &blocks_.front();
  double least_reach = std::numeric_limits<double>::infinity();
  for (const PointBlock& block : blocks_) {
    const double distance = reach(block);
    if (!(distance < least_reach)) continue;
    least_reach = distance;
    first = &block;
  }
  std::size_t nearest = first->begin;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const PointBlock& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const double square = (points_[i] - to).squaredNorm();
      if (square > least || (square == least && i >= nearest)) continue;
      least = square;
      nearest = i;
    }
  };
  look(*first);
  for (const PointBlock& block : blocks_) {
    const double distance = reach(block);
    if (&block != first && !(distance > 0.0 && distance * distance > least)) look(block);
  }
  return nearest;
}

}  // namespace wscvt
