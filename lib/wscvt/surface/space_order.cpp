// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/space_order.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace wscvt {

namespace {

constexpr int bits_a_coordinate = 16;

/// Puts two zeros between the bits of a number below 2^16.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 16) & 0x0000FF0000FFULL;
  x = (x | x << 8) & 0x00F00F00F00FULL;
  x = (x | x << 4) & 0x0C30C30C30C3ULL;
  return (x | x << 2) & 0x249249249249ULL;
}

}  // namespace

std::vector<std::int32_t> space_order(const std::vector<Vector3>& points) {
  if (points.empty()) return {};
  Vector3 low = points.front();
  Vector3 high = points.front();
  for (const Vector3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double extent = (high - low).maxCoeff();
  const double scale = extent > 0.0 ? ((1 << bits_a_coordinate) - 1) / extent : 0.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 at = scale * (points[i] - low);
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) key |= spread_bits(static_cast<std::uint64_t>(at[k])) << k;
    keys[i] = {key, static_cast<std::int32_t>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = keys[i].second;
  return order;
}

std::vector<std::int32_t> order_in_space(std::vector<Vector3>& points,
                                         std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> order = space_order(points);
  std::vector<std::int32_t> numbers(points.size());
  std::vector<Vector3> ordered(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    ordered[i] = points[order[i]];
    numbers[order[i]] = static_cast<std::int32_t>(i);
  }
  points = std::move(ordered);
  for (Triangle& t : triangles) t = {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
  const auto first = [](const Triangle& t) { return std::min({t[0], t[1], t[2]}); };
  std::stable_sort(triangles.begin(), triangles.end(),
                   [&](const Triangle& a, const Triangle& b) { return first(a) < first(b); });
  return order;
}

}  // namespace wscvt
