// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/counting_sort.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "support/seeds.h"

namespace wscvt {
namespace {

using Sets = std::vector<std::set<std::int32_t>>;

/// The groups as sets; fails where one is not in ascending order.
Sets sets_of(const Groups& groups) {
  Sets sets(groups.starts.size() - 1);
  for (std::size_t g = 0; g < sets.size(); ++g) {
    sets[g] = {groups.begin(g), groups.end(g)};
    EXPECT_TRUE(std::equal(groups.begin(g), groups.end(g), sets[g].begin(), sets[g].end()));
  }
  return sets;
}

TEST(CountingSort, PutsEveryItemIntoItsGroups) {
  std::mt19937_64 random(test::announced(4));
  constexpr std::size_t groups = 700;
  Sets expected(groups);
  std::vector<std::vector<std::size_t>> groups_of(30000);
  for (std::size_t item = 0; item < groups_of.size(); ++item) {
    for (std::uint64_t k = random() % 4; k > 0; --k) {
      const std::size_t group = random() % groups;
      if (expected[group].insert(static_cast<std::int32_t>(item)).second) {
        groups_of[item].push_back(group);
      }
    }
  }
  const auto visit_groups = [&](std::size_t item, const auto& visit) {
    for (const std::size_t group : groups_of[item]) visit(group);
  };
  EXPECT_EQ(sets_of(counting_sort(groups_of.size(), groups, visit_groups)), expected);
}

TEST(CountingSort, LeavesGroupsEmpty) {
  const auto into_three = [](std::size_t, const auto& visit) { visit(3); };
  EXPECT_EQ(sets_of(counting_sort(0, 2, into_three)), (Sets{{}, {}}));
  EXPECT_EQ(sets_of(counting_sort(2, 5, into_three)), (Sets{{}, {}, {}, {0, 1}, {}}));
  EXPECT_EQ(counting_sort(0, 0, into_three).starts, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace wscvt
