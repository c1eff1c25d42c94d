// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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

}  // namespace wscvt
