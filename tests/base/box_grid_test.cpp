// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/box_grid.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "support/seeds.h"

namespace wscvt {
namespace {

// Compared with asking all. On a lattice, many boxes are equal, meet in a face only, or are flat.
TEST(BoxGrid, FindsWhatAllPairsFind) {
  std::mt19937_64 engine(test::announced(7));
  std::uniform_int_distribution<int> place(0, 12);
  std::uniform_int_distribution<int> size(0, 3);
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{9}, std::size_t{300}}) {
    std::vector<BoxGrid::Box> boxes;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector3 low(place(engine), place(engine), place(engine));
      boxes.emplace_back(low, Vector3(low + Vector3(size(engine), size(engine), size(engine))));
    }
    if (count > 1) boxes[0] = {Vector3(0, 0, 0), Vector3(20, 20, 20)};
    const BoxGrid grid(boxes);
    EXPECT_FALSE(grid.is_crowded());
    std::vector<std::int32_t> found;
    for (const BoxGrid::Box& box : boxes) {
      std::vector<std::int32_t> expected;
      for (std::size_t k = 0; k < count; ++k) {
        const bool is_apart = (boxes[k].min().array() > box.max().array()).any() ||
                              (boxes[k].max().array() < box.min().array()).any();
        if (!is_apart) expected.push_back(static_cast<std::int32_t>(k));
      }
      grid.find(box, found);
      EXPECT_EQ(found, expected);
    }
    grid.find({Vector3(30, 0, 0), Vector3(40, 1, 1)}, found);
    EXPECT_TRUE(found.empty());
  }
}

// Thirty long boxes would fill too many cells of the size of three thousand short ones.
TEST(BoxGrid, IsCrowdedOnlyWithCellsThatWereAskedFor) {
  std::mt19937_64 engine(test::announced(8));
  std::uniform_real_distribution<double> place(0.0, 1.0);
  const auto point = [&] { return Vector3(place(engine), place(engine), place(engine)); };
  std::vector<BoxGrid::Box> boxes;
  for (int k = 0; k < 3000; ++k) {
    const Vector3 low = point();
    const double size = k % 100 == 0 ? 1.0 : 0.005;
    boxes.emplace_back(low, low + Vector3::Constant(size));
  }
  EXPECT_TRUE(BoxGrid(boxes, 128).is_crowded());
  const BoxGrid grid(boxes);
  EXPECT_FALSE(grid.is_crowded());
  std::vector<std::int32_t> found;
  for (int k = 0; k < 200; ++k) {
    const Vector3 low = 1.5 * point();
    const BoxGrid::Box asked(low, low + 0.1 * point());
    std::vector<std::int32_t> expected;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (asked.intersects(boxes[i])) expected.push_back(static_cast<std::int32_t>(i));
    }
    grid.find(asked, found);
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace wscvt
