// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Boxes with sides along the axes, in the cells of a grid, which finds those that another box
/// meets. Const functions are thread-safe.
class BoxGrid {
 public:
  using Box = Eigen::AlignedBox3d;

  /// Chooses the cells: not smaller than the mean box, and not more on a surface than there are
  /// boxes. `boxes`: finite, none empty.
  explicit BoxGrid(std::vector<Box> boxes);

  /// As above, with a number of cells along the longest side of all boxes, at least 1.
  BoxGrid(std::vector<Box> boxes, int cells_a_side);

  /// Whether the boxes are too large for the cells asked for: a search would ask nearly all boxes.
  /// The grid is empty then. Never with cells that were chosen.
  bool is_crowded() const { return is_crowded_; }

  /// Calls visit(number of a box), possibly several times, for all boxes that `other` meets, and
  /// for some others beside it.
  template <class Visit>
  void visit(const Box& other, const Visit& visit) const {
    for_cells(other, [&](std::size_t cell) {
      for (const auto* box = in_cells_.begin(cell); box != in_cells_.end(cell); ++box) visit(*box);
    });
  }

  /// Sets `found` to the numbers of the boxes that have a point in common with `other`, ascending.
  void find(const Box& other, std::vector<std::int32_t>& found) const;

 private:
  using Cell = Eigen::Array3i;

  /// Bounded, so that a far point has a cell too.
  Cell cell_at(const Vector3& point) const {
    const Eigen::Array3d at = ((point - low_) * cells_a_length_).array();
    return at.max(-1.0).min(1e6).floor().cast<int>();
  }

  /// Calls visit(number of a cell) for the cells of the grid that a box meets.
  template <class Visit>
  void for_cells(const Box& box, const Visit& visit) const {
    const Cell first = cell_at(box.min()).max(0);
    const Cell last = cell_at(box.max()).min(last_);
    const auto size = [](int number) { return static_cast<std::size_t>(number); };
    for (int x = first[0]; x <= last[0]; ++x) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int z = first[2]; z <= last[2]; ++z) {
          visit((size(x) * size(last_[1] + 1) + size(y)) * size(last_[2] + 1) + size(z));
        }
      }
    }
  }

  /// Returns whether the boxes fit into the cells.
  bool fill(int cells_a_side);

  std::vector<Box> boxes_;
  Vector3 low_ = Vector3::Zero();
  double cells_a_length_ = 0.0;
  Cell last_ = Cell::Zero();
  bool is_crowded_ = false;
  Groups in_cells_;
};

}  // namespace wscvt
