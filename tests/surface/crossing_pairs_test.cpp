// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/crossing_pairs.h"

#include <gtest/gtest.h>

#include "support/test_shapes.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

IndexedMesh two_balls(int times) {
  return test::joined(test::sphere(times), test::moved(test::sphere(times), 0.9, {0.7, 0.1, 0.2}));
}

TEST(CrossingPairs, AreAllPairsOfASmallMesh) {
  const CrossingPairs pairs = crossing_pairs(two_balls(1));
  EXPECT_TRUE(pairs.is_all);
  EXPECT_EQ(pairs.count, self_intersections(two_balls(1)).size());
  EXPECT_GT(pairs.count, 0U);
  EXPECT_TRUE(crossing_sentence(crossing_pairs(test::sphere(3)), "it").empty());
}

TEST(CrossingPairs, OfALargeMeshAreSomeOfAllWhereverItLies) {
  for (const double shift : {0.0, 1e6}) {
    const IndexedMesh mesh = test::moved(two_balls(5), 1.0, {shift, -shift, 0});
    const CrossingPairs pairs = crossing_pairs(mesh);
    const std::size_t all = self_intersections(mesh).size();
    EXPECT_FALSE(pairs.is_all);
    // One of 82 faces was looked at, and each pair has two.
    EXPECT_GT(pairs.count, all / 90);
    EXPECT_LT(pairs.count, all / 20);
    EXPECT_EQ(crossing_pairs(test::moved(test::sphere(6), 1.0, {shift, -shift, 0})).count, 0U);
  }
}

}  // namespace
}  // namespace wscvt
