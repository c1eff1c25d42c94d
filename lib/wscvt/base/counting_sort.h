// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"

namespace wscvt {

/// Items sorted into groups; an item may stand in several.
struct Groups {
  std::vector<std::size_t> starts;  ///< of each group in `items`, and the end of the last
  std::vector<std::int32_t> items;  ///< ascending in each group

  const std::int32_t* begin(std::size_t group) const { return items.data() + starts[group]; }
  const std::int32_t* end(std::size_t group) const { return items.data() + starts[group + 1]; }
  std::size_t size(std::size_t group) const { return starts[group + 1] - starts[group]; }
};

/// Counting sort of the items 0 to count - 1 into `groups` groups, in time linear in both:
/// visit_groups(item, visit) calls visit(group) for every group of an item; it runs twice for each
/// item. Items come out in ascending order.
template <class VisitGroups>
Groups counting_sort(std::size_t count, std::size_t groups, const VisitGroups& visit_groups) {
  // Counted two places further on, so that the filling, which moves starts[group + 1] from the
  // beginning of the group to its end, leaves every entry in its own place.
  Groups result;
  result.starts.assign(groups + 2, 0);
  for (std::size_t item = 0; item < count; ++item) {
    visit_groups(item, [&](std::size_t group) { ++result.starts[group + 2]; });
  }
  for (std::size_t k = 2; k < result.starts.size(); ++k) result.starts[k] += result.starts[k - 1];
  result.items.resize(result.starts.back());
  for (std::size_t item = 0; item < count; ++item) {
    visit_groups(item, [&](std::size_t group) {
      result.items[result.starts[group + 1]++] = static_cast<std::int32_t>(item);
    });
  }
  result.starts.pop_back();
  return result;
}

/// The same on the threads of `execution`, for items whose groups take long to find: twice the time
/// of the other where finding them costs nothing. The result does not depend on the threads.
template <class VisitGroups>
Groups counting_sort(std::size_t count, std::size_t groups, const VisitGroups& visit_groups,
                     const Execution& execution) {
  constexpr std::size_t block_size = 8192;
  std::vector<std::atomic<std::size_t>> places(groups);
  for (auto& place : places) place.store(0, std::memory_order_relaxed);
  const auto for_each = [&](const auto& visit) {
    execution.parallel_for(count, block_size, [&](std::size_t begin, std::size_t end) {
      for (std::size_t item = begin; item < end; ++item) {
        visit_groups(item, [&](std::size_t group) { visit(item, group); });
      }
    });
  };
  for_each([&](std::size_t, std::size_t group) {
    places[group].fetch_add(1, std::memory_order_relaxed);
  });
  Groups result;
  result.starts.resize(groups + 1);
  std::size_t sum = 0;
  for (std::size_t group = 0; group < groups; ++group) {
    result.starts[group] = sum;
    sum += places[group].exchange(sum, std::memory_order_relaxed);
  }
  result.starts.back() = sum;
  result.items.resize(sum);
  for_each([&](std::size_t item, std::size_t group) {
    result.items[places[group].fetch_add(1, std::memory_order_relaxed)] =
        static_cast<std::int32_t>(item);
  });
  // Threads fill a group in any order.
  execution.parallel_for(groups, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t group = begin; group < end; ++group) {
      std::sort(result.items.data() + result.starts[group],
                result.items.data() + result.starts[group + 1]);
    }
  });
  return result;
}

}  // namespace wscvt
