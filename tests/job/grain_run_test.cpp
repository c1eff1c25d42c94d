// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/holds.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

using Work = std::function<std::string(std::size_t grain)>;

/// A run of grains that have their numbers as names; `work` returns the record of a grain.
GrainRun run_of(std::size_t first, std::size_t count, const Work& work,
                std::vector<std::string>* taken = nullptr) {
  GrainRun run;
  run.first = first;
  run.count = count;
  run.when_stopped = "Begin again.";
  run.name = [](std::size_t grain) { return "grain " + std::to_string(grain); };
  run.work = [work](std::size_t grain, const Execution&) -> GrainRow { return {{work(grain)}}; };
  run.take = [taken](std::size_t, const GrainRow& row) {
    if (taken != nullptr) taken->push_back(row.records.front());
  };
  return run;
}

/// Returns the message of a run that throws.
std::string message_of(const GrainRun& run, int threads) {
  try {
    run_grains(run, {threads});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InputOutput);
    return error.what();
  }
  return "";
}

/// Counts how many grains are at work for as long as it lives.
class AtWork {
 public:
  explicit AtWork(std::atomic<int>& count) : count_(count), with_others_(++count) {}
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
  ~AtWork() { --count_; }
  bool is_alone() const { return with_others_ == 1 && count_ == 1; }

 private:
  std::atomic<int>& count_;
  int with_others_;
};

TEST(GrainRun, WorksOnAGrainAgainAloneWhereMemoryIsRefused) {
  std::atomic<int> at_work{0};
  std::vector<std::atomic<int>> tries(60);
  std::vector<std::string> taken;
  const JobEnd end = run_grains(run_of(
                                    3, 60,
                                    [&](std::size_t grain) {
                                      const AtWork one(at_work);
                                      std::this_thread::sleep_for(std::chrono::milliseconds(2));
                                      // Every fourth, several at the same time.
                                      if (++tries[grain] == 1 && grain % 4 == 0)
                                        throw std::bad_alloc();
                                      if (grain % 4 == 0) {
                                        EXPECT_TRUE(one.is_alone()) << grain;
                                      }
                                      return std::to_string(grain);
                                    },
                                    &taken),
                                {8});
  EXPECT_EQ(end.done, 60U);
  EXPECT_FALSE(end.was_cancelled());
  ASSERT_EQ(taken.size(), 57U);
  for (std::size_t k = 0; k < taken.size(); ++k) EXPECT_EQ(taken[k], std::to_string(k + 3));
}

TEST(GrainRun, NamesTheGrainThatIsTooLargeAlone) {
  for (const int threads : {1, 4}) {
    std::atomic<int> tries{0};
    std::vector<std::string> taken;
    const std::string message = message_of(run_of(
                                               0, 20,
                                               [&](std::size_t grain) {
                                                 if (grain == 7) {
                                                   ++tries;
                                                   throw std::bad_alloc();
                                                 }
                                                 return std::to_string(grain);
                                               },
                                               &taken),
                                           threads);
    EXPECT_TRUE(test::holds(message, "not enough memory for \"grain 7\""));
    EXPECT_EQ(message.find("--threads 1") != std::string::npos, threads > 1) << message;
    EXPECT_EQ(message.substr(message.size() - 12), "Begin again.");
    EXPECT_EQ(tries, 2);
    EXPECT_LE(taken.size(), 7U);
    for (std::size_t k = 0; k < taken.size(); ++k) EXPECT_EQ(taken[k], std::to_string(k));
  }
}

TEST(GrainRun, IsStoppedWhileAGrainWaitsToBeAlone) {
  std::atomic<bool> has_other{false};
  std::atomic<bool> is_waiting{false};
  std::atomic<bool> stops{false};
  JobHost host{2};
  host.progress = [&](const JobProgress& now) {
    EXPECT_EQ(now.count, 2U);
    stops = is_waiting.load();
    return !stops;
  };
  const JobEnd end =
      run_grains(run_of(0, 2,
                        [&](std::size_t grain) -> std::string {
                          if (grain == 0) {
                            while (!has_other) std::this_thread::yield();
                            is_waiting = true;
                            throw std::bad_alloc();
                          }
                          has_other = true;
                          while (!is_waiting || !stops) std::this_thread::yield();
                          // The run is stopped by then.
                          std::this_thread::sleep_for(std::chrono::milliseconds(200));
                          return "";
                        }),
                 host);
  EXPECT_TRUE(end.was_cancelled());
  EXPECT_EQ(end.done, 0U);
}

TEST(GrainRun, IsStoppedBeforeTheFirstGrain) {
  std::atomic<int> begun{0};
  JobHost host{4};
  std::vector<std::size_t> done;
  host.progress = [&](const JobProgress& now) {
    done.push_back(now.done);
    EXPECT_EQ(now.first, 2U);
    EXPECT_EQ(now.count, 9U);
    return false;
  };
  const JobEnd end = run_grains(run_of(2, 9,
                                       [&](std::size_t grain) {
                                         ++begun;
                                         return std::to_string(grain);
                                       }),
                                host);
  EXPECT_TRUE(end.was_cancelled());
  EXPECT_EQ(begun, 0);
  EXPECT_EQ(done, std::vector<std::size_t>{2});
  EXPECT_EQ(end.done, 2U);
  EXPECT_EQ(end.count, 9U);
  EXPECT_EQ(end.when_stopped, "Begin again.");
}

TEST(GrainRun, StopsAGrainThatIsAtWork) {
  std::atomic<bool> stops{false};
  bool is_stopped = false;
  GrainRun run = run_of(0, 3, {});
  run.work = [&](std::size_t grain, const Execution& execution) -> GrainRow {
    stops = grain == 1;
    try {
      execution.report(0.5, "At work");
    } catch (const Error& error) {
      is_stopped = error.code() == ErrorCode::Cancelled;
      throw;
    }
    return {{"row"}};
  };
  JobHost host{1};
  host.is_cancelled = [&] { return stops.load(); };
  const JobEnd end = run_grains(run, host);
  EXPECT_EQ(end.done, 1U);
  EXPECT_TRUE(end.was_cancelled() && is_stopped);
}

// The rows behind it would fill the memory.
TEST(GrainRun, DoesNotRunFarAheadOfAGrainThatTakesLong) {
  constexpr std::size_t ahead = 64;  // 32 a thread
  std::atomic<std::size_t> begun{0};
  const JobEnd end = run_grains(run_of(0, 2000,
                                       [&](std::size_t grain) {
                                         ++begun;
                                         if (grain > 0) return "";
                                         while (begun < ahead) std::this_thread::yield();
                                         std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                         EXPECT_EQ(begun, ahead);
                                         return "";
                                       }),
                                {2});
  EXPECT_EQ(end.done, 2000U);
}

TEST(GrainRun, CountsFailuresBehindThoseOfBefore) {
  GrainRun run = run_of(3, 9, {});
  run.failed = 2;
  run.work = [](std::size_t grain, const Execution&) -> GrainRow {
    return {{"row"}, grain % 2 == 0 ? "" : "It broke."};
  };
  std::vector<std::string> told;
  JobHost host{1};
  host.failed = [&](const std::string& grain, const std::string& error) {
    told.push_back(grain + ": " + error);
  };
  const JobEnd end = run_grains(run, host);
  EXPECT_EQ(end.failed, 5U);
  EXPECT_EQ(told, (std::vector<std::string>{"grain 3: It broke.", "grain 5: It broke.",
                                            "grain 7: It broke."}));
}

TEST(GrainRun, OnlyFailuresOfTheGrainAreItsRow) {
  const auto row_of = [](const std::function<void()>& fault) {
    return row_or_failure(
        [&]() -> GrainRow {
          fault();
          return {{"made"}};
        },
        [](const std::string& error) -> GrainRow {
          return {{"failed"}, error};
        });
  };
  EXPECT_EQ(row_of([] {}).records.front(), "made");
  EXPECT_EQ(row_of([] { throw Error(ErrorCode::InvalidInput, "No grain."); }).error, "No grain.");
  EXPECT_EQ(row_of([] { throw std::runtime_error("Broken."); }).error, "Broken.");
  EXPECT_THROW(row_of([] { throw Error(ErrorCode::Cancelled, "Stop."); }), Error);
  EXPECT_THROW(row_of([] { throw MachineRefused(Sentence("Full.")); }), MachineRefused);
  EXPECT_THROW(row_of([] { throw std::bad_alloc(); }), std::bad_alloc);
}

TEST(GrainRun, AnExceptionEndsIt) {
  for (const int threads : {1, 3}) {
    std::atomic<int> begun{0};
    const auto work = [&](std::size_t grain) {
      ++begun;
      if (grain == 5) throw std::runtime_error("here");
      return "";
    };
    const std::string message = message_of(run_of(2, 100000, work), threads);
    const std::string expected = threads == 1 ? "after 5 of 100000 grains." : " of 100000 grains.";
    EXPECT_TRUE(test::holds(message, expected + " here Begin again."));
    EXPECT_LT(begun, 100000);
  }
}

}  // namespace
}  // namespace wscvt
