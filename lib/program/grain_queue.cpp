// SPDX-License-Identifier: GPL-3.0-or-later
#include "grain_queue.h"

#include <chrono>
#include <thread>
#include <utility>
#include <vector>

namespace wscvt::program {

GrainQueue::GrainQueue(std::size_t first, std::size_t count, Work work, Take take)
    : next_(first), taken_(first), count_(count), work_(std::move(work)), take_(std::move(take)) {}

void GrainQueue::work_on_grains() {
  std::unique_lock<std::mutex> lock(mutex_);
  try {
    while (true) {
      changed_.wait(lock,
                    [&] { return stopped_ || next_ == count_ || next_ < taken_ + most_ahead_; });
      if (stopped_ || next_ == count_) break;
      const std::size_t grain = next_++;
      lock.unlock();
      GrainRow row = work_(grain);
      lock.lock();
      waiting_.emplace(grain, std::move(row));
      for (auto first = waiting_.begin();
           !stopped_ && first != waiting_.end() && first->first == taken_;
           first = waiting_.erase(first)) {
        take_(first->second);
        ++taken_;
      }
      changed_.notify_all();
    }
  } catch (...) {
    if (!lock.owns_lock()) lock.lock();
    if (!failure_) failure_ = std::current_exception();
    stopped_ = true;
  }
  --working_;
  changed_.notify_all();
}

void GrainQueue::run(int threads, const Watch& watch) {
  constexpr std::size_t grains_ahead = 32;  // of each thread: some take a hundred times as long
  most_ahead_ = grains_ahead * static_cast<std::size_t>(threads);
  working_ = threads;
  std::vector<std::thread> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int i = 0; i < threads; ++i) workers.emplace_back([this] { work_on_grains(); });
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
