// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Returns the smallest box of a triangle, with sides along the axes.
inline Eigen::AlignedBox3d box_of(const std::array<Vector3, 3>& corners) {
  return {corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
          corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
}

/// Boxes with sides along the axes, in a grid of cells that finds those that another box may meet.
/// For boxes that are asked once for many others: a tree would cost more to build.
class BoxGrid {
 public:
  using Box = Eigen::AlignedBox3d;

  /// `boxes`: at least one, none empty. `cells_a_side`, at least 1: along the longest side of all.
  BoxGrid(const std::vector<Box>& boxes, int cells_a_side) {
    // Usual are 10 cells a box. Of a grid with more, the cells have so many boxes that it is slow.
    const std::size_t most_entries = 100 * boxes.size();
    Box all;
    for (const Box& box : boxes) all.extend(box);
    low_ = all.min();
    const double extent = all.sizes().maxCoeff();
    cells_a_length_ = extent > 0.0 ? cells_a_side / extent : 0.0;
    last_ = cell_at(all.max());
    const auto visit_cells = [&](std::size_t i, const auto& visit) { for_cells(boxes[i], visit); };
    std::size_t entries = 0;
    for (std::size_t i = 0; i < boxes.size() && entries <= most_entries; ++i) {
      visit_cells(i, [&](std::size_t /*cell*/) { ++entries; });
    }
    is_crowded_ = entries > most_entries;
    if (is_crowded_) return;
    const auto cells = (last_ + Cell::Ones()).cast<std::size_t>().prod();
    boxes_ = counting_sort(boxes.size(), cells, visit_cells);
  }

  /// Whether the boxes are too large for the cells. The grid is empty then. A grid of one cell
  /// never is.
  bool is_crowded() const { return is_crowded_; }

  /// Calls visit(number of a box), possibly several times, for each box that `other` may meet.
  template <class Visit>
  void visit(const Box& other, const Visit& visit) const {
    for_cells(other, [&](std::size_t cell) {
      for (const auto* box = boxes_.begin(cell); box != boxes_.end(cell); ++box) visit(*box);
    });
  }

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
    for (int x = first[0]; x <= last[0]; ++x) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int z = first[2]; z <= last[2]; ++z) {
          visit(static_cast<std::size_t>((x * (last_[1] + 1) + y) * (last_[2] + 1) + z));
        }
      }
    }
  }

  Vector3 low_;
  double cells_a_length_ = 0.0;
  Cell last_ = Cell::Zero();
  bool is_crowded_ = false;
  Groups boxes_;
};

}  // namespace wscvt
