// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/suggestions.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "support/expect_error.h"

namespace wscvt {
namespace {

/// What is tried, and what comes of it.
struct Trials {
  std::vector<RemeshOptions> tried;
  RemeshWith remesh_with = [this](const RemeshOptions& options, const Execution&) {
    tried.push_back(options);
    RemeshResult result;
    result.rms_distance = 0.06;
    result.input.equivalent_radius = 2.0;
    result.original.area = 10.0;
    result.remesh.area = 9.5;
    return result;
  };
};

/// Work of a run that any trial is affordable beside.
constexpr std::uint64_t much = std::uint64_t{1} << 60;

TEST(Suggestions, TryOneSettingWithAsManyNodes) {
  std::vector<RemeshOptions> runs(4);
  runs[1].method = AsPublishedOptions();
  OnScanOptions on_surface;
  on_surface.placement = ScanPlacement::OnSurface;
  runs[2].method = on_surface;
  OnScanOptions adaptive;
  adaptive.weighting = CellWeighting::Curvature;
  runs[3].method = adaptive;
  for (RemeshOptions& run : runs) {
    run.node_count = 700;
    run.target.percent = 1.0;
    run.measures.distances = true;
    Trials trials;
    const auto suggestions = suggest_settings(run, much, trials.remesh_with, Execution(1));
    // Of a run's cost each, so no second one, and none of more nodes.
    ASSERT_EQ(trials.tried.size(), 1U);
    EXPECT_EQ(trials.tried[0].node_count, 700);
    EXPECT_EQ(trials.tried[0].target.percent, 0.0);
    EXPECT_FALSE(trials.tried[0].measures.distances);
    ASSERT_TRUE(std::holds_alternative<OnScanOptions>(trials.tried[0].method));
    const auto& other = std::get<OnScanOptions>(trials.tried[0].method);
    EXPECT_EQ(other.placement, ScanPlacement::Fitted);
    ASSERT_EQ(suggestions.size(), 1U);
    EXPECT_NE(suggestions[0].setting, "");
    EXPECT_DOUBLE_EQ(suggestions[0].rms_distance, 0.03);
    EXPECT_NEAR(suggestions[0].area_difference, -0.05, 1e-15);
  }
}

TEST(Suggestions, CostNoMoreThanTheRun) {
  RemeshOptions run;
  run.node_count = 100;
  Trials trials;
  // Known beforehand to cost more.
  EXPECT_TRUE(suggest_settings(run, 999999, trials.remesh_with, Execution(1)).empty());
  EXPECT_TRUE(trials.tried.empty());
  EXPECT_EQ(suggest_settings(run, 1000000, trials.remesh_with, Execution(1)).size(), 1U);
  // Found out on the way.
  std::uint64_t done = 0;
  const auto costly = [&](const RemeshOptions&, const Execution& execution) -> RemeshResult {
    for (int round = 0; round < 1000; ++round) {
      execution.part(0.0, 0.5).parallel_for(3000, 100, [](std::size_t, std::size_t) {});
      done += 3000;
    }
    return {};
  };
  EXPECT_TRUE(suggest_settings(run, 1000000, costly, Execution(2)).empty());
  EXPECT_LE(done, 500000U);
  EXPECT_GT(done, 490000U);
}

TEST(Suggestions, WrapsAreTriedUntilOneWorks) {
  std::vector<double> tried;
  const auto only_above = [&](double least) {
    return [&tried, least](const RemeshOptions& options, const Execution&) -> RemeshResult {
      EXPECT_FALSE(options.measures.suggestions);
      tried.push_back(options.envelope.opening_percent);
      if (options.envelope.opening_percent < least) refuse("Too fine.");
      return {};
    };
  };
  EXPECT_EQ(working_opening({}, 5.0, only_above(8.0), Execution(1)), 10.0);
  EXPECT_EQ(tried, (std::vector<double>{5.0, 10.0}));
  tried.clear();
  EXPECT_EQ(working_opening({}, 7.0, only_above(30.0), Execution(1)), std::nullopt);
  EXPECT_EQ(tried, (std::vector<double>{7.0, 14.0}));
  EXPECT_EQ(working_opening({}, 20.0, only_above(20.0), Execution(1)), 20.0);
}

TEST(Suggestions, DoNotTryTheRunAgain) {
  OnScanOptions closest;
  closest.edge_ratio = 1.5;
  RemeshOptions run;
  run.method = closest;
  Trials trials;
  EXPECT_TRUE(suggest_settings(run, much, trials.remesh_with, Execution(1)).empty());
  EXPECT_TRUE(trials.tried.empty());
}

TEST(Suggestions, WhatFailsOrIsCancelledIsNone) {
  const auto failing = [](ErrorCode code) {
    return [code](const RemeshOptions&, const Execution&) -> RemeshResult {
      throw Error(code, "It does not work.");
    };
  };
  const RemeshOptions run;
  for (const ErrorCode code : {ErrorCode::InvalidInput, ErrorCode::NumericalFailure}) {
    EXPECT_TRUE(suggest_settings(run, much, failing(code), Execution(1)).empty());
  }
  EXPECT_ERROR(suggest_settings(run, much, failing(ErrorCode::Cancelled), Execution(1)), Cancelled);
}

}  // namespace
}  // namespace wscvt
