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
#include <thread>

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

/// Thrown if a grain is abandoned because the run was stopped.
struct GivenUp {};

/// The work of run_grains.
class GrainQueue {
 public:
  GrainQueue(const GrainRun& run, const JobHost& host)
      : run_(run), host_(host), next_(run.first), done_(run.first), failed_(run.failed) {}

  /// Works until all rows are taken, or until the host stops it. After a stop, `run.work` ends the
  /// grains in progress; rows after the first missing row are lost. Uses as many threads as the
  /// system starts. If no thread starts, works on the caller's thread and asks the host after each
  /// grain. Throws GrainTooLarge, and exceptions of the run's functions.
  void work(int threads) {
    constexpr std::size_t grains_ahead =
        32;  // per thread: some grains take a hundred times as long
    most_ahead_ = grains_ahead * static_cast<std::size_t>(threads);
    if (!goes_on()) return;
    std::vector<std::thread> workers = started(threads);
    if (workers.empty()) {
      working_ = 1;
      work_on_grains(true);
    }
    {
      std::unique_lock<std::mutex> lock(mutex_);
      while (working_ > 0) {
        changed_.wait_for(lock, std::chrono::milliseconds(200));
        lock.unlock();
        const bool is_over = !goes_on();
        lock.lock();
        if (is_over) changed_.notify_all();
      }
    }
    for (std::thread& worker : workers) worker.join();
    if (failure_) std::rethrow_exception(failure_);
  }

  JobEnd end() const { return {done_, failed_, run_.count, run_.when_stopped}; }

 private:
  bool is_stopped() const { return stopped_ || (host_.is_cancelled && host_.is_cancelled()); }

  /// Tells the host of the progress, and asks it whether to stop.
  bool goes_on() {
    const bool is_wanted =
        !host_.progress || host_.progress({run_.first, done_, failed_, run_.count});
    if (!is_wanted || is_stopped()) stopped_ = true;
    return !stopped_;
  }

  std::vector<std::thread> started(int threads) {
    std::vector<std::thread> workers;
    working_ = threads;
    try {
      workers.reserve(static_cast<std::size_t>(threads));
      for (int i = 0; i < threads; ++i) workers.emplace_back([this] { work_on_grains(false); });
    } catch (const std::exception&) {
      // No more threads, or no memory for one: the threads already started are enough.
      const std::lock_guard<std::mutex> lock(mutex_);
      working_ -= threads - static_cast<int>(workers.size());
    }
    return workers;
  }

  void work_on_grains(bool asks_host) {
    std::unique_lock<std::mutex> lock(mutex_);
    try {
      while (true) {
        changed_.wait(lock, [&] {
          return stopped_ || next_ == run_.count ||
                 (too_large_ == 0 && next_ < done_ + most_ahead_);
        });
        if (is_stopped() || next_ == run_.count) break;
        const std::size_t grain = next_++;
        waiting_.emplace(grain, row_of(grain, lock));
        for (auto first = waiting_.begin();
             !stopped_ && first != waiting_.end() && first->first == done_;
             first = waiting_.erase(first)) {
          take(first->second);
        }
        changed_.notify_all();
        if (asks_host) goes_on();
      }
    } catch (const GivenUp&) {
      // The reason for the stop is known already.
    } catch (...) {
      if (!failure_) failure_ = std::current_exception();
      stopped_ = true;
    }
    --working_;
    changed_.notify_all();
  }

  GrainRow row_of(std::size_t grain, std::unique_lock<std::mutex>& lock) {
    try {
      return made(grain, lock);
    } catch (const std::bad_alloc&) {
      ++too_large_;
    }
    changed_.notify_all();
    changed_.wait(lock, [&] { return stopped_ || at_work_ == 0; });
    if (stopped_) throw GivenUp();
    system_files::return_free_memory();  // of the other threads' grains
    try {
      GrainRow row = made(grain, lock);
      --too_large_;
      return row;
    } catch (const std::bad_alloc&) {
      throw GrainTooLarge(grain);
    }
  }

  /// Makes a row while the lock is open.
  GrainRow made(std::size_t grain, std::unique_lock<std::mutex>& lock) {
    ++at_work_;
    lock.unlock();
    GrainRow row;
    std::exception_ptr thrown;
    try {
      row = run_.work(grain,
                      Execution(1, [this](double, const std::string&) { return !is_stopped(); }));
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    --at_work_;
    if (thrown) std::rethrow_exception(thrown);
    return row;
  }

  void take(const GrainRow& row) {
    const std::size_t grain = done_;
    if (run_.take) run_.take(grain, row);
    ++done_;
    if (row.error.empty()) return;
    ++failed_;
    if (host_.failed) host_.failed(run_.name(grain), row.error);
  }

  const GrainRun& run_;
  const JobHost& host_;
  std::size_t next_;               ///< to be begun
  std::atomic<std::size_t> done_;  ///< rows that are taken
  std::atomic<std::size_t> failed_;
  std::atomic<bool> stopped_{false};
  std::size_t most_ahead_ = 0;
  std::map<std::size_t, GrainRow> waiting_;
  int working_ = 0;    ///< threads
  int at_work_ = 0;    ///< grains
  int too_large_ = 0;  ///< grains that wait for, or are in, a second try without other grains
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

int thread_count(int asked, std::size_t grains) {
  const int all = asked > 0 ? asked : static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1, static_cast<int>(std::min<std::size_t>(all, grains)));
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
  GrainQueue queue(run, host);
  try {
    queue.work(thread_count(host.threads, run.count));
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    if (known == nullptr || known->code() != ErrorCode::Cancelled) {
      throw Error(ErrorCode::InputOutput, "Stopped after " + std::to_string(queue.end().done) +
                                              " of " + std::to_string(run.count) + " grains. " +
                                              sentence_of(error, run, host) + " " +
                                              run.when_stopped);
    }
  }
  return queue.end();
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
