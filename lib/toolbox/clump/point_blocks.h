// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A range of neighbouring points, with a ball that contains them.
struct PointBlock {
  std::size_t begin = 0;
  std::size_t end = 0;
  Vector3 centre = Vector3::Zero();
  double radius = 0.0;
};

/// Points in blocks of at most 32, so that a search skips distant blocks. The points are reordered,
/// in an order that does not depend on the standard library.
class PointBlocks {
 public:
  explicit PointBlocks(std::vector<Vector3> points);

  const std::vector<Vector3>& points() const { return points_; }
  const std::vector<PointBlock>& blocks() const { return blocks_; }

  /// Returns the index of the nearest point, the first of equals. There must be at least one point.
  std::size_t nearest(const Vector3& to) const;

 private:
  void split(std::size_t begin, std::size_t end);

  std::vector<Vector3> points_;
  std::vector<PointBlock> blocks_;
};

}  // namespace wscvt
