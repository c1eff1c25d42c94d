// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/box_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "support/seeds.h"

namespace wscvt {
namespace {

// Compared with asking all. On a lattice, many boxes are equal, meet in a face only, or are flat.
TEST(BoxTree, FindsWhatAllPairsFind) {
  std::mt19937_64 engine(test::announced(7));
  std::uniform_int_distribution<int> place(0, 12);
  std::uniform_int_distribution<int> size(0, 3);
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{9}, std::size_t{300}}) {
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector3 low(place(engine), place(engine), place(engine));
      boxes.push_back({low, low + Vector3(size(engine), size(engine), size(engine))});
    }
    if (count > 1) boxes[0] = {{0, 0, 0}, {20, 20, 20}};
    const BoxTree tree(boxes);
    for (const Box& box : boxes) {
      std::vector<std::size_t> expected;
      for (std::size_t k = 0; k < count; ++k) {
        const bool is_apart = (boxes[k].low.array() > box.high.array()).any() ||
                              (boxes[k].high.array() < box.low.array()).any();
        if (!is_apart) expected.push_back(k);
      }
      EXPECT_EQ(tree.meeting(box), expected);
    }
    EXPECT_TRUE(tree.meeting({{30, 0, 0}, {40, 1, 1}}).empty());
  }
}

}  // namespace
}  // namespace wscvt
