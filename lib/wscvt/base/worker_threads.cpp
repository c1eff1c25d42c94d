// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/worker_threads.h"

#include <atomic>
#include <exception>
#include <system_error>

namespace wscvt {

/// A loop that is running.
class WorkerThreads::Loop {
 public:
  Loop(std::size_t count, const std::function<void(std::size_t)>& run) : count_(count), run_(run) {}

  bool has_work() const { return next_ < count_; }

  /// Runs indices until all are taken.
  void work() {
    try {
      for (std::size_t index = next_++; index < count_; index = next_++) run_(index);
    } catch (...) {
      next_ = count_;
      const std::lock_guard<std::mutex> lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  int helpers = 0;  ///< threads at work beside the caller; protected by the mutex of WorkerThreads

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& run_;
  std::atomic<std::size_t> next_{0};
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

WorkerThreads::WorkerThreads(int wanted) {
  try {
    threads_.reserve(static_cast<std::size_t>(wanted));
    for (int i = 0; i < wanted; ++i) threads_.emplace_back([this] { wait_for_loops(); });
  } catch (const std::system_error&) {
    // The system has no more threads, or no memory for their stacks. Continue with the started
    // ones.
  } catch (...) {
    stop();
    throw;
  }
}

WorkerThreads::~WorkerThreads() { stop(); }

void WorkerThreads::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  posted_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

WorkerThreads::Loop* WorkerThreads::loop_with_work() {
  for (Loop* loop : loops_) {
    if (loop->has_work()) return loop;
  }
  return nullptr;
}

void WorkerThreads::wait_for_loops() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!is_ending_) {
    Loop* const loop = loop_with_work();
    if (loop == nullptr) {
      posted_.wait(lock);
      continue;
    }
    ++loop->helpers;
    lock.unlock();
    loop->work();
    lock.lock();
    if (--loop->helpers == 0) left_.notify_all();
  }
}

void WorkerThreads::for_each(std::size_t count, const std::function<void(std::size_t)>& run) {
  Loop loop(count, run);
  std::list<Loop*> entry(1, &loop);
  const auto place = entry.begin();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    loops_.splice(loops_.begin(), entry);
  }
  posted_.notify_all();
  loop.work();
  {
    std::unique_lock<std::mutex> lock(mutex_);
    loops_.erase(place);
    left_.wait(lock, [&] { return loop.helpers == 0; });
  }
  loop.rethrow();
}

}  // namespace wscvt
