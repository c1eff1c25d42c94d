// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/worker_threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "support/own_user.h"

namespace wscvt {
namespace {

using namespace std::chrono_literals;

/// Whether a loop over a thousand indices, and one in each of its bodies, run every index once.
bool covers_every_index(WorkerThreads& workers) {
  std::vector<std::atomic<int>> seen(1000);
  std::atomic<int> inner{0};
  workers.for_each(seen.size(), [&](std::size_t index) {
    ++seen[index];
    if (index % 100 == 0) workers.for_each(7, [&](std::size_t) { ++inner; });
  });
  for (const std::atomic<int>& count : seen) {
    if (count != 1) return false;
  }
  return inner == 70;
}

TEST(WorkerThreads, RunEveryIndexOnceAlsoInLoopsWithinLoops) {
  for (const int wanted : {0, 1, 2, 13}) {
    WorkerThreads workers(wanted);
    EXPECT_EQ(workers.size(), static_cast<std::size_t>(wanted));
    for (int times = 0; times < 50; ++times) EXPECT_TRUE(covers_every_index(workers));
  }
}

TEST(WorkerThreads, ShareALoopWithItsCaller) {
  WorkerThreads workers(3);
  // Each of four indices waits for the others: none of the four threads can do two.
  std::atomic<int> arrived{0};
  std::vector<std::thread::id> threads(4);
  workers.for_each(4, [&](std::size_t index) {
    threads[index] = std::this_thread::get_id();
    ++arrived;
    while (arrived < 4) std::this_thread::yield();
  });
  EXPECT_EQ(std::set<std::thread::id>(threads.begin(), threads.end()).size(), 4U);
  EXPECT_EQ(std::count(threads.begin(), threads.end(), std::this_thread::get_id()), 1);
}

TEST(WorkerThreads, TakeLoopsOfSeveralCallers) {
  WorkerThreads workers(2);
  std::vector<std::thread> callers;
  std::atomic<int> good{0};
  for (int k = 0; k < 4; ++k) {
    callers.emplace_back([&] {
      for (int times = 0; times < 20; ++times) good += covers_every_index(workers) ? 1 : 0;
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(good, 80);
}

TEST(WorkerThreads, AnExceptionEndsTheLoopAndLeavesTheThreads) {
  for (const int wanted : {0, 3}) {
    WorkerThreads workers(wanted);
    std::atomic<int> ran{0};
    EXPECT_THROW(workers.for_each(1000000,
                                  [&](std::size_t index) {
                                    ++ran;
                                    if (index != 5) {
                                      // Nor are they done before it has thrown, on a busy machine.
                                      if (ran > 2000) std::this_thread::sleep_for(1us);
                                      return;
                                    }
                                    // Others are at the loop by then.
                                    while (wanted > 0 && ran < 1000) std::this_thread::yield();
                                    throw std::runtime_error("here");
                                  }),
                 std::runtime_error);
    EXPECT_LT(ran, 1000000);
    EXPECT_TRUE(covers_every_index(workers));
  }
}

/// In a process of its own: 0 where loops are right with as many threads as the system gives.
int with_few_threads(rlim_t most) {
  const rlimit both = {most, most};
  [[maybe_unused]] const bool is_root = getuid() == 0;  // who has no limit
  if (!test::become_own_user()) return 2;
  if (setrlimit(RLIMIT_NPROC, &both) != 0) return 3;
  WorkerThreads workers(13);
  if (workers.size() > most - 1) return 4;
#if !defined(__SANITIZE_THREAD__)  // which has a thread of its own
  if (is_root && workers.size() != most - 1) return 5;
#endif
  return covers_every_index(workers) ? 0 : 6;
}

TEST(WorkerThreads, GoOnWithAsManyAsTheSystemStarts) {
  // A user who is not root may have other processes, which count.
  for (const rlim_t most :
       getuid() == 0 ? std::vector<rlim_t>{1, 2, 5, 8} : std::vector<rlim_t>{1}) {
    SCOPED_TRACE(most);
    EXPECT_EXIT(_exit(with_few_threads(most)), testing::ExitedWithCode(0), "");
  }
}

}  // namespace
}  // namespace wscvt
