// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace wscvt::program {

/// Result of a grain.
struct GrainRow {
  std::string record;                    ///< of the table
  std::string error;                     ///< the message of a failure; empty: no failure
  std::vector<std::string> others = {};  ///< records of further tables, in the tables' order
};

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
  /// Called from time to time during the work; false stops it.
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

}  // namespace wscvt::program
