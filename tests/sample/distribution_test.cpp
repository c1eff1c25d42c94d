// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wscvt {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TEST(Distribution, QuantilesLieBetweenTheMiddlesOfTheWeights) {
  // Weights 1, 2, 5 of 8: the middles of the grains lie at 1/16, 4/16 and 11/16.
  const Distribution one(vector_of({7.0, 3.0, 4.0}), vector_of({5.0, 1.0, 2.0}));
  EXPECT_EQ(one.values(), (std::vector<double>{3.0, 4.0, 7.0}));
  EXPECT_EQ(one.grains(), (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_NEAR(one.quantile(4.0 / 16.0), 4.0, 1e-15);
  EXPECT_NEAR(one.quantile(7.5 / 16.0), 5.5, 1e-15);
  EXPECT_EQ(one.quantile(0.0), 3.0);
  EXPECT_EQ(one.quantile(0.9), 7.0);
}

TEST(Distribution, OfEqualWeightsIsTheOneByNumber) {
  const Distribution one(vector_of({2.0, 10.0, 4.0, 5.0}));
  EXPECT_NEAR(one.quantile(0.5), 4.5, 1e-15);
  EXPECT_NEAR(one.mean(), 5.25, 1e-15);
  // The squares add up to 34.75, over n - 1.
  EXPECT_NEAR(one.deviation(), std::sqrt(34.75 / 3.0), 1e-14);
}

TEST(Distribution, AGrainOfTwiceTheWeightCountsAsTwo) {
  const Distribution twice(vector_of({1.0, 6.0}), vector_of({1.0, 2.0}));
  EXPECT_NEAR(twice.mean(), 13.0 / 3.0, 1e-15);
  // sum w d^2 = 100/9 + 2 * 25/9 = 150/9; W - sum w^2 / W = 3 - 5/3.
  EXPECT_NEAR(twice.deviation(), std::sqrt(150.0 / 9.0 / (4.0 / 3.0)), 1e-14);
}

TEST(Distribution, LeavesOutWhatHasNoValueOrNoWeight) {
  const Distribution one(vector_of({missing, 3.0, 5.0, 9.0}), vector_of({1.0, 2.0, missing, 0.0}));
  EXPECT_EQ(one.values(), std::vector<double>{3.0});
  EXPECT_EQ(one.quantile(0.3), 3.0);
  EXPECT_TRUE(std::isnan(one.deviation()));
  EXPECT_TRUE(std::isnan(Distribution().quantile(0.5)));
}

TEST(Quantile, OfValuesIsThatOfTheirDistribution) {
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_EQ(quantile({3.0}, 0.9), 3.0);
  const std::vector<double> values = {1.0, 2.0, 2.0, 3.5, 7.0, 11.0};
  for (const double fraction : {0.0, 0.05, 0.1, 0.25, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(quantile(values, fraction), Distribution(values).quantile(fraction), 1e-14)
        << fraction;
  }
}

}  // namespace
}  // namespace wscvt
