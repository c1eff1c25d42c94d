// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace wscvt {

/// Items sorted into groups; an item may be in several groups.
struct Groups {
  std::vector<std::size_t> starts;  ///< of each group in `items`, and the end of the last
  std::vector<std::int32_t> items;  ///< ascending in each group

  const std::int32_t* begin(std::size_t group) const { return items.data() + starts[group]; }
  const std::int32_t* end(std::size_t group) const { return items.data() + starts[group + 1]; }
};

/// Sorts the items 0 to count - 1 into `groups` groups by counting, in time linear in both.
/// visit_groups(item, visit) must call visit(group) for every group of an item; it runs twice per
/// item. Items are in ascending order in each group.
template <class VisitGroups>
Groups counting_sort(std::size_t count, std::size_t groups, const VisitGroups& visit_groups) {
  // Counts go two entries further on. Filling then moves starts[group + 1] from the group's
  // beginning to its end, so every entry ends at its own index.
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

}  // namespace wscvt
