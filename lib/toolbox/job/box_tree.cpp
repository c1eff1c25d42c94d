// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace wscvt {

namespace {

bool meet(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (a.high.array() >= b.low.array()).all();
}

Vector3 middle_of(const Box& box) { return 0.5 * box.low + 0.5 * box.high; }

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) build(0, order_.size());
}

void BoxTree::build(std::size_t begin, std::size_t end) {
  Node node{boxes_[order_[begin]], begin, end, 0};
  Box middles{middle_of(node.box), middle_of(node.box)};
  for (std::size_t k = begin; k < end; ++k) {
    const Box& box = boxes_[order_[k]];
    node.box.low = node.box.low.cwiseMin(box.low);
    node.box.high = node.box.high.cwiseMax(box.high);
    middles.low = middles.low.cwiseMin(middle_of(box));
    middles.high = middles.high.cwiseMax(middle_of(box));
  }
  const std::size_t place = nodes_.size();
  nodes_.push_back(node);
  constexpr std::size_t few = 8;
  if (end - begin <= few) return;
  Eigen::Index axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const std::size_t half = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(half), at(end), [&](std::size_t a, std::size_t b) {
    return middle_of(boxes_[a])[axis] < middle_of(boxes_[b])[axis];
  });
  build(begin, half);
  nodes_[place].second_half = nodes_.size();
  build(half, end);
}

std::vector<std::size_t> BoxTree::meeting(const Box& box) const {
  std::vector<std::size_t> found;
  std::vector<std::size_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::size_t place = open.back();
    open.pop_back();
    const Node& node = nodes_[place];
    if (!meet(node.box, box)) continue;
    if (node.second_half > 0) {
      open.push_back(place + 1);
      open.push_back(node.second_half);
      continue;
    }
    for (std::size_t k = node.begin; k < node.end; ++k) {
      if (meet(boxes_[order_[k]], box)) found.push_back(order_[k]);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace wscvt
