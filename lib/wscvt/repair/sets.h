// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace wscvt {

/// Sets of the items 0 to count - 1 that can be united. At first each item is a set.
class Sets {
 public:
  explicit Sets(std::size_t count)
      : parent_(count), rank_(count, 0), sets_(rank_.data(), parent_.data()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void unite(std::size_t a, std::size_t b) {
    sets_.union_set(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
  }

  /// Returns the number of the set of each item, in the order of their first items, and the number
  /// of sets.
  std::pair<std::vector<std::int32_t>, std::size_t> numbers() {
    std::vector<std::int32_t> number(parent_.size(), -1);
    std::vector<std::int32_t> of_root(parent_.size(), -1);
    std::int32_t count = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      const std::int32_t root = sets_.find_set(static_cast<std::int32_t>(i));
      std::int32_t& known = of_root[static_cast<std::size_t>(root)];
      if (known < 0) known = count++;
      number[i] = known;
    }
    return {std::move(number), static_cast<std::size_t>(count)};
  }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<unsigned char> rank_;
  boost::disjoint_sets<unsigned char*, std::int32_t*> sets_;
};

}  // namespace wscvt
