// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/step_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace wscvt {
namespace {

/// The step at which a watch ends a relaxation with these displacements; `limit` if it does not.
template <class Watch, class Displacement>
int end_of(bool (Watch::*ends_at)(double), const Displacement& displacement, int limit) {
  Watch watch;
  for (int step = 1; step < limit; ++step) {
    if ((watch.*ends_at)(displacement(step))) return step;
  }
  return limit;
}

int stall(const std::function<double(int)>& displacement) {
  return end_of(&StallWatch::stalled_at, displacement, 5000);
}

TEST(StallWatch, EndsWhatNoLongerGains) {
  // The first fifty steps are the best; three more without a gain end it.
  EXPECT_EQ(stall([](int) { return 0.05; }), 200);
  // So do displacements that go up and down about a mean, or up.
  EXPECT_EQ(stall([](int step) { return 0.05 + 0.04 * (step % 2); }), 200);
  EXPECT_EQ(stall([](int step) { return 0.01 * step; }), 200);
  // One that fell to a floor at its 100th step: the mean of the third fifty is the best.
  EXPECT_EQ(stall([](int step) { return std::max(0.05 * std::exp(-0.05 * step), 3e-4); }), 300);
}

TEST(StallWatch, WaitsForWhatStillGains) {
  // A tenth in fifty steps is a gain; a twentieth is the least that is.
  EXPECT_EQ(stall([](int step) { return std::pow(0.9, step / 50.0); }), 5000);
  EXPECT_EQ(stall([](int step) { return std::pow(0.94, step / 50.0); }), 5000);
  // Gains below a twentieth add up: against the best, not against the fifty before.
  EXPECT_EQ(stall([](int step) { return std::pow(0.98, step / 50.0); }), 5000);
  EXPECT_LT(stall([](int step) { return std::pow(0.99, step / 50.0); }), 5000);
  // A rest of a hundred steps is not the end.
  EXPECT_EQ(stall([](int step) { return std::pow(0.5, step / 150); }), 5000);
}

TEST(Momentum, GrowsTowardsOneAndIsDroppedUphill) {
  Momentum momentum;
  EXPECT_EQ(momentum.carry(false), 0.0);
  double last = 0.0;
  for (int step = 0; step < 100; ++step) {
    const double share = momentum.carry(false);
    EXPECT_GT(share, last);
    EXPECT_LT(share, 1.0);
    last = share;
  }
  // Nesterov's weights grow by a half a step, so shares come to 1 - 3 / (step + 3).
  EXPECT_NEAR(last, 1.0 - 3.0 / 103.0, 2e-3);
  EXPECT_EQ(momentum.carry(true), 0.0);
}

}  // namespace
}  // namespace wscvt
