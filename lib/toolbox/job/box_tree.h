// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/repair/weld.h"

namespace wscvt {

/// Finds the boxes that meet a box without asking all: 100,000 bodies have 5 billion pairs. Boxes
/// are halved by their middles along the axis in which these spread the most.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Returns the places of all boxes that have a point in common with `box`, ascending.
  std::vector<std::size_t> meeting(const Box& box) const;

 private:
  struct Node {
    Box box;  ///< of all boxes in it
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t second_half = 0;  ///< a node; the first half is the next one; 0: it is not halved
  };

  void build(std::size_t begin, std::size_t end);

  std::vector<Box> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace wscvt
