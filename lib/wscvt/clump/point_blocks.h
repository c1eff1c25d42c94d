// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Points beside each other, by their places, in a ball.
struct PointBlock {
  std::size_t begin = 0;
  std::size_t end = 0;
  Vector3 centre = Vector3::Zero();
  double radius = 0.0;
};

/// Points in blocks of at most 32, so that a search passes over those that are far. The order of
/// the points is another one than was given, and the same for every library.
class PointBlocks {
 public:
  explicit PointBlocks(std::vector<Vector3> points);

  const std::vector<Vector3>& points() const { return points_; }
  const std::vector<PointBlock>& blocks() const { return blocks_; }

  /// Index of the nearest point; the first of equals. There must be one.
  std::size_t nearest(const Vector3& to) const;

 private:
  void split(std::size_t begin, std::size_t end);

  std::vector<Vector3> points_;
  std::vector<PointBlock> blocks_;
};

}  // namespace wscvt
