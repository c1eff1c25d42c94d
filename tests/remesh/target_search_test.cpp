// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/target_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/expect_error.h"

namespace wscvt {
namespace {

TEST(NodeCountSearch, FindsTheSmallestCountFromAnywhere) {
  // 660 / N %, the loss of volume by chords: 1.5 % takes exactly 440.
  for (const int start : {4, 100, 440, 5000, 100000}) {
    SCOPED_TRACE(start);
    const NodeCountSearch search =
        smallest_node_count(1.5, start, 4, 100000, [](int n) { return 660.0 / n; });
    EXPECT_TRUE(search.met);
    EXPECT_GE(search.node_count, 440);
    EXPECT_LE(search.node_count, 1.02 * 440);
  }
}

TEST(NodeCountSearch, FewNodesAreFoundToTheNode) {
  const NodeCountSearch search =
      smallest_node_count(20.0, 100, 4, 1000, [](int n) { return 660.0 / n; });
  EXPECT_TRUE(search.met);
  EXPECT_EQ(search.node_count, 33);
}

// A remesh takes time in proportion to its nodes, and more for its scan.
TEST(NodeCountSearch, TakesTheTimeOfAtMostSixRemeshes) {
  for (const double exponent : {0.8, 1.0, 1.3}) {
    for (const double needed : {300.0, 730.0, 1000.0, 2900.0, 7900.0}) {
      SCOPED_TRACE(testing::Message() << exponent << " " << needed);
      double nodes = 0.0;
      const NodeCountSearch search = smallest_node_count(0.5, 1000, 4, 20000, [&](int n) {
        nodes += n;
        return 0.5 * std::pow(needed / n, exponent);
      });
      EXPECT_TRUE(search.met);
      EXPECT_GE(search.node_count, needed);
      EXPECT_LE(search.node_count, 1.02 * needed + 1.0);
      // From a first trial that is larger than what is needed, that trial comes on top.
      EXPECT_LE(nodes, 6.0 * std::max(needed, 1000.0));
      EXPECT_LE(search.trials.size(), 7U);
    }
  }
}

TEST(NodeCountSearch, ClosesToTwoPercentOfLargeCounts) {
  const NodeCountSearch search =
      smallest_node_count(0.01, 1000, 4, 1000000, [](int n) { return 660.0 / n; });
  EXPECT_TRUE(search.met);
  EXPECT_GE(search.node_count, 66000);
  EXPECT_LE(search.node_count, 66000 * 1.02 + 1);
}

TEST(NodeCountSearch, WhatItReturnsMeetsTheTargetAlsoWhenTheErrorWavers) {
  const auto error = [](int n) { return 660.0 / n * (1.0 + 0.2 * std::sin(n)); };
  const NodeCountSearch search = smallest_node_count(1.0, 100, 4, 100000, error);
  EXPECT_TRUE(search.met);
  EXPECT_LE(error(search.node_count), 1.0);
  int largest_below = 0;
  for (const NodeCountTrial& trial : search.trials) {
    EXPECT_EQ(trial.error, error(trial.node_count));
    if (trial.node_count < search.node_count) {
      largest_below = std::max(largest_below, trial.node_count);
    }
  }
  EXPECT_GT(error(largest_below), 1.0);
}

TEST(NodeCountSearch, SaysSoWhenNoCountMeetsTheTarget) {
  const NodeCountSearch search =
      smallest_node_count(1.0, 100, 4, 500, [](int n) { return 660.0 / n; });
  EXPECT_FALSE(search.met);
  EXPECT_EQ(search.node_count, 500);
  EXPECT_LE(search.trials.size(), 5U);
}

TEST(NodeCountSearch, GoesDownToTheSmallestCount) {
  const NodeCountSearch search = smallest_node_count(1.0, 1000, 4, 5000, [](int) { return 0.0; });
  EXPECT_TRUE(search.met);
  EXPECT_EQ(search.node_count, 4);
}

TEST(NodeCountSearch, RefusesTargetsAndLimitsThatMakeNoSense) {
  const auto error = [](int n) { return 1.0 / n; };
  for (const double target : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    SCOPED_TRACE(target);
    test::expect_error(ErrorCode::InvalidInput,
                       [&] { smallest_node_count(target, 10, 4, 20, error); });
  }
  test::expect_error(ErrorCode::InvalidInput, [&] { smallest_node_count(1.0, 10, 20, 4, error); });
  test::expect_error(ErrorCode::InvalidInput, [&] { smallest_node_count(1.0, 10, 0, 4, error); });
}

}  // namespace
}  // namespace wscvt
