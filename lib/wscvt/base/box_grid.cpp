// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/box_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/sorting.h"

namespace wscvt {

BoxGrid::BoxGrid(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  constexpr double most_cells_a_side = 128.0;  // 16 MB
  Box all;
  double sum = 0.0;
  for (const Box& box : boxes_) {
    all.extend(box);
    sum += box.sizes().maxCoeff();
  }
  const auto count = static_cast<double>(boxes_.size());
  double wanted = std::sqrt(count);
  if (sum > 0.0) wanted = std::min(wanted, all.sizes().maxCoeff() / (sum / count));
  auto cells_a_side = static_cast<int>(std::clamp(wanted, 1.0, most_cells_a_side));
  while (!fill(cells_a_side)) cells_a_side /= 2;
}

BoxGrid::BoxGrid(std::vector<Box> boxes, int cells_a_side) : boxes_(std::move(boxes)) {
  is_crowded_ = !fill(cells_a_side);
}

bool BoxGrid::fill(int cells_a_side) {
  // A box usually has 10 cells. Where the boxes have 100, each cell has so many of them that
  // asking all boxes is as fast. With one cell along each side a box has at most 8.
  const std::size_t most_entries = 100 * boxes_.size();
  Box all;
  for (const Box& box : boxes_) all.extend(box);
  if (!all.isEmpty()) {
    low_ = all.min();
    const double extent = all.sizes().maxCoeff();
    cells_a_length_ = extent > 0.0 ? cells_a_side / extent : 0.0;
    last_ = cell_at(all.max());
  }
  const auto visit_cells = [&](std::size_t i, const auto& visit) { for_cells(boxes_[i], visit); };
  std::size_t entries = 0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    visit_cells(i, [&](std::size_t /*cell*/) { ++entries; });
    if (entries > most_entries) return false;
  }
  const auto cells = (last_ + Cell::Ones()).cast<std::size_t>().prod();
  in_cells_ = counting_sort(boxes_.size(), cells, visit_cells);
  return true;
}

void BoxGrid::find(const Box& other, std::vector<std::int32_t>& found) const {
  found.clear();
  visit(other, [&](std::int32_t box) {
    if (other.intersects(boxes_[static_cast<std::size_t>(box)])) found.push_back(box);
  });
  sort_unique(found);
}

}  // namespace wscvt
