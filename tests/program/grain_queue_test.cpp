// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/grain_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace wscvt::program {
namespace {

bool go_on() { return true; }

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

TEST(GrainQueue, WorksOnAGrainAgainAloneWhereMemoryIsRefused) {
  std::atomic<int> at_work{0};
  std::vector<std::atomic<int>> tries(60);
  std::vector<std::string> taken;
  GrainQueue queue(
      3, 60,
      [&](std::size_t grain) -> GrainRow {
        const AtWork one(at_work);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        // Every fourth, several at the same time.
        if (++tries[grain] == 1 && grain % 4 == 0) throw std::bad_alloc();
        if (grain % 4 == 0) {
          EXPECT_TRUE(one.is_alone()) << grain;
        }
        return {std::to_string(grain), ""};
      },
      [&](const GrainRow& row) { taken.push_back(row.record); });
  queue.run(8, go_on);
  ASSERT_EQ(taken.size(), 57U);
  for (std::size_t k = 0; k < taken.size(); ++k) EXPECT_EQ(taken[k], std::to_string(k + 3));
}

TEST(GrainQueue, NamesTheGrainThatIsTooLargeAlone) {
  for (const int threads : {1, 4}) {
    std::atomic<int> tries{0};
    std::vector<std::string> taken;
    GrainQueue queue(
        0, 20,
        [&](std::size_t grain) -> GrainRow {
          if (grain == 7) {
            ++tries;
            throw std::bad_alloc();
          }
          return {std::to_string(grain), ""};
        },
        [&](const GrainRow& row) { taken.push_back(row.record); });
    try {
      queue.run(threads, go_on);
      FAIL() << "all fit";
    } catch (const GrainTooLarge& error) {
      EXPECT_EQ(error.grain(), 7U);
    }
    EXPECT_EQ(tries, 2);
    EXPECT_LE(taken.size(), 7U);
    for (std::size_t k = 0; k < taken.size(); ++k) EXPECT_EQ(taken[k], std::to_string(k));
  }
}

TEST(GrainQueue, IsStoppedWhileAGrainWaitsToBeAlone) {
  std::atomic<bool> has_other{false};
  std::atomic<bool> is_waiting{false};
  std::atomic<bool> stops{false};
  GrainQueue queue(
      0, 2,
      [&](std::size_t grain) -> GrainRow {
        if (grain == 0) {
          while (!has_other) std::this_thread::yield();
          is_waiting = true;
          throw std::bad_alloc();
        }
        has_other = true;
        while (!is_waiting || !stops) std::this_thread::yield();
        std::this_thread::sleep_for(
            std::chrono::milliseconds(200));  // the queue is stopped by then
        return {"", ""};
      },
      [](const GrainRow&) {});
  EXPECT_NO_THROW(queue.run(2, [&] {
    stops = is_waiting.load();
    return !stops;
  }));
}

TEST(GrainQueue, AFailureEndsIt) {
  std::atomic<int> begun{0};
  GrainQueue queue(
      0, 100000,
      [&](std::size_t grain) -> GrainRow {
        ++begun;
        if (grain == 5) throw std::runtime_error("here");
        return {"", ""};
      },
      [](const GrainRow&) {});
  EXPECT_THROW(queue.run(3, go_on), std::runtime_error);
  EXPECT_LT(begun, 100000);
}

}  // namespace
}  // namespace wscvt::program
