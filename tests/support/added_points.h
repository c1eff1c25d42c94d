// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt::test {

/// Fails unless each of the last `added` points has it farther to the nearest other one than the
/// median has: they were put where there was room.
inline void expect_room_about_the_last(const std::vector<Vector3>& points, std::size_t added) {
  std::vector<double> nearest;
  for (const Vector3& p : points) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Vector3& q : points) {
      if (&p != &q) smallest = std::min(smallest, (p - q).norm());
    }
    nearest.push_back(smallest);
  }
  std::vector<double> sorted = nearest;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 1; k <= added; ++k) {
    EXPECT_GT(nearest[points.size() - k], sorted[points.size() / 2]);
  }
}

}  // namespace wscvt::test
