// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/weld.h"

#include <cstring>

#include "wscvt/scan/half_edges.h"

namespace wscvt {

using namespace half_edges;

namespace {

std::uint64_t hash_of(const Vector3& point) {
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) {
    const double coordinate = point[k] + 0.0;  // -0 equals 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  }
  return hash * 0xD6E8FEB86659FD93U;
}

}  // namespace

Weld find_equal_points(const std::vector<Vector3>& points, const Execution& execution) {
  const std::size_t count = points.size();
  unsigned bits = 2;
  while ((std::size_t{1} << bits) < 2 * count) ++bits;
  std::vector<std::uint32_t> slots(count);
  execution.parallel_for(count, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      slots[i] = static_cast<std::uint32_t>(hash_of(points[i]) >> (64U - bits));
    }
  });
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  std::vector<std::int32_t> table(mask + 1, -1);
  Weld weld;
  std::vector<std::int32_t>& first = weld.first;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t slot = slots[i];
    while (table[slot] >= 0 && points[index(table[slot])] != points[i]) slot = (slot + 1) & mask;
    if (table[slot] < 0) {
      table[slot] = static_cast<std::int32_t>(i);
      if (!first.empty()) first[i] = static_cast<std::int32_t>(i);
      continue;
    }
    if (first.empty()) {
      first.resize(count);
      for (std::size_t j = 0; j < i; ++j) first[j] = static_cast<std::int32_t>(j);
    }
    first[i] = table[slot];
    ++weld.welded;
  }
  return weld;
}

}  // namespace wscvt
