// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/execution.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/expect_error.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

TEST(Execution, ParallelForCoversEveryIndexOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> seen(1001, 0);
    Execution(threads).parallel_for(seen.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const int count : seen) EXPECT_EQ(count, 1);
  }
}

TEST(Execution, SumHasTheSameBitsOnAnyNumberOfThreads) {
  const auto sum = [](int threads) {
    return Execution(threads).parallel_sum(std::size_t{100000}, 333, 0.0,
                                           [](std::size_t begin, std::size_t end) {
                                             double part = 0.0;
                                             for (std::size_t i = begin; i < end; ++i)
                                               part += std::sin(static_cast<double>(i));
                                             return part;
                                           });
  };
  const double one = sum(1);
  for (const int threads : {2, 3, 7}) {
    const double many = sum(threads);
    EXPECT_EQ(std::memcmp(&one, &many, sizeof one), 0);
  }
}

TEST(Execution, ExceptionFromAThreadReachesTheCaller) {
  EXPECT_THROW(Execution(2).parallel_for(100, 1,
                                         [](std::size_t begin, std::size_t) {
                                           if (begin == 57) throw std::runtime_error("here");
                                         }),
               std::runtime_error);
}

TEST(Execution, ReportsToNobodyAreNothing) {
  const Execution silent(1);
  EXPECT_NO_THROW(silent.report(0.5, "stage"));
  EXPECT_NO_THROW(silent.part(0.2, 0.4).report(0.5, "stage"));
}

TEST(Execution, ProgressIsScaledToThePartAndCancels) {
  std::vector<double> fractions;
  const Execution whole(1, [&](double fraction, const std::string&) {
    fractions.push_back(fraction);
    return fractions.size() < 3;
  });
  whole.part(0.5, 1.0).part(0.0, 0.5).report(0.5, "stage");
  whole.report(7.0, "stage");
  ASSERT_EQ(fractions.size(), 2U);
  EXPECT_DOUBLE_EQ(fractions[0], 0.625);
  EXPECT_DOUBLE_EQ(fractions[1], 1.0);
  try {
    whole.report(0.0, "stage");
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
    // What became of anyone's files or layers the library cannot say.
    EXPECT_STREQ(error.what(), "Cancelled during: stage.");
  }
}

TEST(Execution, LoopsRepeatTheLastReportOnTheCallersThread) {
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(threads);
    const std::thread::id caller = std::this_thread::get_id();
    int calls = 0;
    const Execution execution(threads, [&](double fraction, const std::string& stage) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_EQ(fraction, 0.25);
      EXPECT_EQ(stage, "stage");
      ++calls;
      return true;
    });
    execution.report(0.25, "stage");
    std::atomic<int> on_caller{0};
    execution.part(0.5, 1.0).parallel_for(200, 2, [&](std::size_t, std::size_t) {
      if (std::this_thread::get_id() == caller) ++on_caller;
      // One loop in another's body must not call from a worker.
      execution.parallel_for(4, 2, [](std::size_t, std::size_t) {});
    });
    // Once a block of the caller's own, of the outer loop and of the inner ones.
    EXPECT_GE(calls, 1 + on_caller);
    if (threads == 1) {
      EXPECT_EQ(calls, 1 + 100 + 200);
    }
  }
}

TEST(Execution, ALoopIsCancelledBetweenItsBlocks) {
  for (const int threads : {1, 2, 3}) {
    int calls = 0;
    std::atomic<int> blocks{0};
    const Execution execution(threads, [&](double, const std::string&) { return ++calls < 3; });
    EXPECT_ERROR(execution.parallel_for(1000000, 1,
                                        [&](std::size_t, std::size_t) {
                                          ++blocks;
                                          std::this_thread::yield();
                                        }),
                 Cancelled);
    EXPECT_EQ(calls, 3);
    EXPECT_LT(blocks, 1000000);
  }
}

TEST(Execution, ACancelBeforeTheFirstStageNamesNone) {
  const Execution execution(1, [](double, const std::string&) { return false; });
  try {
    execution.parallel_for(100, 1, [](std::size_t, std::size_t) {});
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
    EXPECT_STREQ(error.what(), "Cancelled.");
  }
}

TEST(Execution, ProgressNeverGoesBackWithinARun) {
  std::vector<double> fractions;
  const Execution whole(1, [&](double fraction, const std::string&) {
    fractions.push_back(fraction);
    return true;
  });
  whole.report(0.0, "first run");
  whole.part(0.2, 0.6).report(1.0, "stage");
  whole.part(0.2, 0.6).report(0.5, "a stage that runs again");
  whole.part(0.0, 0.0).report(0.0, "a stage without a share");
  whole.report(1.0, "done");
  whole.report(0.0, "second run");
  EXPECT_EQ(fractions, (std::vector<double>{0.0, 0.6, 0.6, 0.6, 1.0, 0.0}));
}

TEST(Execution, MoreThreadsThanTheMachineHasAreNoReasonToWrite) {
  testing::internal::CaptureStderr();
  Execution(1000).parallel_for(5000, 1, [](std::size_t, std::size_t) {});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Execution, RefusesNegativeThreads) { EXPECT_ERROR(Execution(-1), InvalidInput); }

}  // namespace
}  // namespace wscvt
