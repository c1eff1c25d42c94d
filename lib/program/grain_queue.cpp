// SPDX-License-Identifier: GPL-3.0-or-later
#include "grain_queue.h"

#include <malloc.h>

#include <chrono>
#include <system_error>
#include <utility>

namespace wscvt::program {

namespace {

/// Thrown if a grain is abandoned because the queue was stopped.
struct GivenUp {};

}  // namespace

GrainQueue::GrainQueue(std::size_t first, std::size_t count, Work work, Take take)
    : next_(first), taken_(first), count_(count), work_(std::move(work)), take_(std::move(take)) {}

GrainRow GrainQueue::row_of(std::size_t grain, std::unique_lock<std::mutex>& lock) {
  ++at_work_;
  lock.unlock();
  try {
    GrainRow row = work_(grain);
    lock.lock();
    --at_work_;
    return row;
  } catch (const std::bad_alloc&) {
    lock.lock();
    --at_work_;
  } catch (...) {
    lock.lock();
    --at_work_;
    throw;
  }
  return row_alone(grain, lock);
}

GrainRow GrainQueue::row_alone(std::size_t grain, std::unique_lock<std::mutex>& lock) {
  ++too_large_;
  changed_.notify_all();
  changed_.wait(lock, [&] { return stopped_ || at_work_ == 0; });
  if (stopped_) throw GivenUp();
  ++at_work_;
  lock.unlock();
  ::malloc_trim(0);  // returns memory of the other threads' grains to the system
  std::exception_ptr thrown;
  GrainRow row;
  try {
    row = work_(grain);
  } catch (const std::bad_alloc&) {
    thrown = std::make_exception_ptr(GrainTooLarge(grain));
  } catch (...) {
    thrown = std::current_exception();
  }
  lock.lock();
  --at_work_;
  --too_large_;
  changed_.notify_all();
  if (thrown) std::rethrow_exception(thrown);
  return row;
}

void GrainQueue::work_on_grains(const Watch& watch) {
  std::unique_lock<std::mutex> lock(mutex_);
  try {
    while (true) {
      changed_.wait(lock, [&] {
        return stopped_ || next_ == count_ || (too_large_ == 0 && next_ < taken_ + most_ahead_);
      });
      if (stopped_ || next_ == count_) break;
      const std::size_t grain = next_++;
      waiting_.emplace(grain, row_of(grain, lock));
      for (auto first = waiting_.begin();
           !stopped_ && first != waiting_.end() && first->first == taken_;
           first = waiting_.erase(first)) {
        take_(first->second);
        ++taken_;
      }
      changed_.notify_all();
      if (!watch) continue;
      lock.unlock();
      const bool goes_on = watch();
      lock.lock();
      if (!goes_on) stopped_ = true;
    }
  } catch (const GivenUp&) {
    // The reason for the stop is known already.
  } catch (...) {
    if (!lock.owns_lock()) lock.lock();
    if (!failure_) failure_ = std::current_exception();
    stopped_ = true;
  }
  --working_;
  changed_.notify_all();
}

void GrainQueue::start(int threads, std::vector<std::thread>& workers) {
  workers.reserve(static_cast<std::size_t>(threads));
  try {
    for (int i = 0; i < threads; ++i) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        ++working_;
      }
      workers.emplace_back([this] { work_on_grains({}); });
    }
  } catch (const std::exception&) {
    // No more threads, or no memory for one: the threads already started are enough.
    const std::lock_guard<std::mutex> lock(mutex_);
    --working_;
  }
}

void GrainQueue::run(int threads, const Watch& watch) {
  constexpr std::size_t grains_ahead = 32;  // per thread: some grains take a hundred times as long
  most_ahead_ = grains_ahead * static_cast<std::size_t>(threads);
  std::vector<std::thread> workers;
  start(threads, workers);
  if (workers.empty()) {
    working_ = 1;
    work_on_grains(watch);
  }
  {
    std::unique_lock<std::mutex> lock(mutex_);
    while (working_ > 0) {
      changed_.wait_for(lock, std::chrono::milliseconds(200));
      lock.unlock();
      const bool goes_on = watch();
      lock.lock();
      if (!goes_on) stopped_ = true;
      if (stopped_) changed_.notify_all();
    }
  }
  for (std::thread& worker : workers) worker.join();
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace wscvt::program
