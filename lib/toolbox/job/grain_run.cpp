// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/system_files.h"

namespace wscvt {

namespace {

/// Memory was not enough for a grain, even while no other grain was worked on.
class GrainTooLarge : public std::bad_alloc {
 public:
  explicit GrainTooLarge(std::size_t grain) : grain_(grain) {}
  std::size_t grain() const { return grain_; }

 private:
  std::size_t grain_;
};

/// Works on the grains of a batch, one grain per thread, and passes on their rows in the order of
/// the grains. Few rows wait for an earlier row, because grains far ahead of it are not begun. If
/// memory is not enough for a grain, the queue tries it again while no other grain is worked on.
class GrainQueue {
 public:
  /// Called on several threads at once.
  using Work = std::function<GrainRow(std::size_t grain)>;
  /// Takes the row of the next grain. Called on one thread at a time.
  using Take = std::function<void(const GrainRow& row)>;
  /// Called before the work and from time to time during it; false stops it.
  using Watch = std::function<bool()>;

  GrainQueue(std::size_t first, std::size_t count, Work work, Take take);

  /// Works until all rows are taken, or until `watch` stops it. After a stop, `work` ends the
  /// grains in progress; rows after the first missing row are lost. Uses as many threads as the
  /// system starts. If no thread starts, works on the caller's thread and calls `watch` after each
  /// grain. Throws GrainTooLarge, and exceptions of `work` and `take`.
  void run(int threads, const Watch& watch);

 private:
  void start(int threads, std::vector<std::thread>& workers);
  void work_on_grains(const Watch& watch);
  GrainRow row_of(std::size_t grain, std::unique_lock<std::mutex>& lock);
  GrainRow row_alone(std::size_t grain, std::unique_lock<std::mutex>& lock);

  std::size_t next_;   ///< to be begun
  std::size_t taken_;  ///< rows
  std::size_t count_;
  Work work_;
  Take take_;
  std::size_t most_ahead_ = 0;
  std::map<std::size_t, GrainRow> waiting_;
  bool stopped_ = false;
  int working_ = 0;    ///< threads
  int at_work_ = 0;    ///< grains
  int too_large_ = 0;  ///< grains that wait for, or are in, a second try without other grains
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// Thrown if a grain is abandoned because the queue was stopped.
struct GivenUp {};

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
  system_files::return_free_memory();  // of the other threads' grains
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
  if (!watch()) return;
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

int thread_count(int asked, std::size_t grains) {
  const int all = asked > 0 ? asked : static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1,
                  static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(all), grains)));
}

/// Returns why a run was stopped, and what to do.
Sentence sentence_of(const std::exception& error, const GrainRun& run, const JobHost& host) {
  if (const auto* too_large = dynamic_cast<const GrainTooLarge*>(&error)) {
    return "There is not enough memory for \"" + run.name(too_large->grain()) +
           "\", although no other grain used memory at the same time. " +
           // Threads keep memory that they have used.
           (thread_count(host.threads, run.count) > 1
                ? "Run the call again with " + mention("threads", "1") + "."
                : Sentence("Use a machine with more memory, raise its limit (ulimit -v), simplify "
                           "this scan, or leave it out of the inputs."));
  }
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return "There is not enough memory. Use a machine with more memory or raise its limit (ulimit "
           "-v).";
  }
  const auto* known = dynamic_cast<const Error*>(&error);
  return known == nullptr ? Sentence(error.what()) : known->sentence();
}

}  // namespace

JobEnd run_grains(const GrainRun& run, const JobHost& host) {
  std::atomic<std::size_t> done{run.first};
  std::atomic<std::size_t> failed{run.failed};
  std::atomic<bool> stopped{false};
  const auto is_stopped = [&] { return stopped || (host.is_cancelled && host.is_cancelled()); };
  const auto work = [&](std::size_t k) {
    return run.work(k, Execution(1, [&](double, const std::string&) { return !is_stopped(); }));
  };
  const auto take = [&](const GrainRow& row) {
    const std::size_t grain = done;
    if (run.take) run.take(grain, row);
    ++done;
    if (row.error.empty()) return;
    ++failed;
    if (host.failed) host.failed(run.name(grain), row.error);
  };
  GrainQueue queue(run.first, run.count, work, take);
  try {
    queue.run(thread_count(host.threads, run.count), [&] {
      const bool goes_on = !host.progress || host.progress({run.first, done, failed, run.count});
      if (!goes_on || is_stopped()) stopped = true;
      return !stopped;
    });
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    if (known == nullptr || known->code() != ErrorCode::Cancelled) {
      throw Error(ErrorCode::InputOutput,
                  "Stopped after " + std::to_string(done) + " of " + std::to_string(run.count) +
                      " grains. " + sentence_of(error, run, host) + " " + run.when_stopped);
    }
  }
  return {done, failed, run.count, run.when_stopped};
}

GrainRow row_or_failure(const std::function<GrainRow()>& make,
                        const std::function<GrainRow(const std::string& error)>& failed) {
  try {
    return make();
  } catch (const MachineRefused&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    return failed(error.what());
  } catch (const std::exception& error) {
    return failed(error.what());
  }
}

}  // namespace wscvt
