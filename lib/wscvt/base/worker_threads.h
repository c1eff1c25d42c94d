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

/// Threads that share loops with the threads that call them. It goes on with as many threads as the
/// system starts; with none the callers work alone.
///
/// Own code in the place of oneTBB, because oneTBB 2021.8 ends the program where the system refuses
/// a thread to one of its own: in 13 of 15 runs with 14 threads asked for and 2 to 7 allowed
/// (ulimit -u). In the other two it threw.
class WorkerThreads {
 public:
  /// `wanted` >= 0 threads beside the callers.
  explicit WorkerThreads(int wanted);
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;
  ~WorkerThreads();

  /// Threads that were started.
  std::size_t size() const { return threads_.size(); }

  /// Calls run(index) once for each index below `count`, on the calling thread and on those that
  /// are free. Several threads may call it at the same time, also from within `run`. When `run`
  /// throws, indices that were not begun are left out, and the first exception reaches the caller.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& run);

 private:
  class Loop;

  void stop();
  void wait_for_loops();
  Loop* loop_with_work();

  std::mutex mutex_;  ///< of what follows
  std::condition_variable posted_;
  std::condition_variable left_;
  std::list<Loop*> loops_;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace wscvt
