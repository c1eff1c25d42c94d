// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace wscvt {

/// Threads that share loops with their callers. Uses as many threads as the system starts. If the
/// system starts none, only the callers work.
///
/// Replaces oneTBB, because oneTBB 2021.8 ends the program if the system refuses a thread: in 13 of
/// 15 runs with 14 threads requested and 2 to 7 allowed (ulimit -u). In the other two runs it
/// threw.
class WorkerThreads {
 public:
  /// `wanted` >= 0 threads beside the callers.
  explicit WorkerThreads(int wanted);
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;
  ~WorkerThreads();

  /// Threads that were started.
  std::size_t size() const { return threads_.size(); }

  /// Calls run(index) once for each index below `count`, on the calling thread and on free threads.
  /// Several threads may call it at the same time, also from within `run`. If `run` throws, the
  /// indices that were not begun are left out, and the caller gets the first exception.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& run);

 private:
  class Loop;

  void stop();
  void wait_for_loops();
  Loop* loop_with_work();

  std::mutex mutex_;  ///< protects the members below
  std::condition_variable posted_;
  std::condition_variable left_;
  std::list<Loop*> loops_;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace wscvt
