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

/// What became of a grain.
struct GrainRow {
  std::string record;                    ///< of the table
  std::string error;                     ///< the sentence of a failure; empty: none
  std::vector<std::string> others = {};  ///< records of further tables, in their order
};

/// Memory was not enough for a grain, not even while no other was worked on.
class GrainTooLarge : public std::bad_alloc {
 public:
  explicit GrainTooLarge(std::size_t grain) : grain_(grain) {}
  std::size_t grain() const { return grain_; }

 private:
  std::size_t grain_;
};

/// Works on the grains of a batch, one a thread, and hands on the row of each in the order of the
/// grains. Rows that wait for an earlier one are few: grains far ahead of it are not begun. A grain
/// for which there is not enough memory is worked on again, alone.
class GrainQueue {
 public:
  /// Called on several threads at once.
  using Work = std::function<GrainRow(std::size_t grain)>;
  /// Takes the row of the next grain. Called on one thread at a time.
  using Take = std::function<void(const GrainRow& row)>;
  /// Called every now and then while grains are worked on; false stops.
  using Watch = std::function<bool()>;

  GrainQueue(std::size_t first, std::size_t count, Work work, Take take);

  /// Works until all rows are taken, or until told to stop: then grains that are being worked on
  /// are left to `work`, whose rows after the first missing one are lost. Goes on with as many of
  /// the threads as the system starts; with none it works on the caller's, and `watch` is called
  /// after each grain. Throws GrainTooLarge, and what else `work` and `take` throw.
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
  int too_large_ = 0;  ///< grains that wait to be worked on alone, or are
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace wscvt::program
