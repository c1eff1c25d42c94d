// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/target_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/remesh/remesh_result.h"

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

namespace {

double error_of(ErrorMeasure measure, const ShapeDescriptors& remesh, const ShapeDescriptors& scan,
                const std::optional<MeshDistances>& distances = std::nullopt) {
  RemeshResult result;
  result.remesh = remesh;
  result.scan = scan;
  result.distances = distances;
  return error_percent(result, measure);
}

TEST(ErrorMeasure, OfAScaledBodyArePowersOfTheScaleAndNeverNegative) {
  const IndexedMesh box = test::box(1, 2, 3);
  for (const double scale : {1.1, 0.9}) {
    SCOPED_TRACE(scale);
    const ShapeDescriptors scaled =
        describe_shape(test::scaled(box, Vector3::Constant(scale)), Execution(1));
    const auto error = [&](ErrorMeasure measure) {
      return error_of(measure, scaled, describe_shape(box, Execution(1)));
    };
    EXPECT_NEAR(error(ErrorMeasure::Volume), 100.0 * std::abs(std::pow(scale, 3) - 1.0), 1e-11);
    EXPECT_NEAR(error(ErrorMeasure::Area), 100.0 * std::abs(scale * scale - 1.0), 1e-11);
    EXPECT_NEAR(error(ErrorMeasure::Sphericity), 0.0, 1e-11);
    EXPECT_NEAR(error(ErrorMeasure::Inertia), 100.0 * std::abs(std::pow(scale, 5) - 1.0), 1e-10);
  }
}

TEST(ErrorMeasure, OfAnotherShapeIsThatOfItsSphericity) {
  // A cube's sphericity is (pi / 6)^(1/3), that of a box of 1 x 2 x 3 (pi 36^2)^(1/3) / 22.
  const double cube = std::cbrt(test::pi / 6.0);
  const double box = std::cbrt(test::pi * 36.0 * 36.0) / 22.0;
  EXPECT_NEAR(error_of(ErrorMeasure::Sphericity, describe_shape(test::box(1, 2, 3), Execution(1)),
                       describe_shape(test::box(1, 1, 1), Execution(1))),
              100.0 * (1.0 - box / cube), 1e-11);
}

TEST(ErrorMeasure, OfDistancesIsTheirRmsInEquivalentRadii) {
  // The original is a box of the volume of a ball of radius 2.
  const double side = 2.0 * std::cbrt(4.0 * test::pi / 3.0);
  const ShapeDescriptors original = describe_shape(test::box(side, side, side), Execution(1));
  const ShapeDescriptors remesh = describe_shape(test::box(1, 1, 1), Execution(1));
  MeshDistances distances;
  distances.largest = 0.5;
  distances.root_mean_square = 0.03;
  EXPECT_NEAR(error_of(ErrorMeasure::Distance, remesh, original, distances), 1.5, 1e-12);
  EXPECT_ERROR(error_of(ErrorMeasure::Distance, remesh, original), InvalidInput);
}

}  // namespace
}  // namespace wscvt
