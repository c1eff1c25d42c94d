// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/execution.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/worker_threads.h"

namespace wscvt {

/// Shared by all copies and parts of an execution: the threads and the last report.
class Execution::Arena {
 public:
  explicit Arena(int threads) {
    if (threads > 1) workers.emplace(threads - 1);
  }

  std::optional<WorkerThreads> workers;  ///< empty if only the caller works
  /// The thread whose loop runs now. Only this thread repeats the progress, between its own blocks,
  /// because the callback belongs to the thread that called the library.
  std::atomic<std::thread::id> caller{};
  std::mutex mutex;  ///< protects the two members below
  double fraction = 0.0;
  std::string stage;
};

namespace {

/// Makes this thread the caller during a loop, unless the loop is inside another loop's body.
class CallerOfLoop {
 public:
  explicit CallerOfLoop(std::atomic<std::thread::id>& caller) : caller_(caller) {
    std::thread::id nobody;
    is_outer_ = caller_.compare_exchange_strong(nobody, std::this_thread::get_id());
  }
  CallerOfLoop(const CallerOfLoop&) = delete;
  CallerOfLoop& operator=(const CallerOfLoop&) = delete;
  ~CallerOfLoop() {
    if (is_outer_) caller_ = std::thread::id();
  }

 private:
  std::atomic<std::thread::id>& caller_;
  bool is_outer_ = false;
};

[[noreturn]] void cancel(const std::string& stage) {
  throw Error(ErrorCode::Cancelled,
              (stage.empty() ? "Cancelled" : "Cancelled during: " + stage) + ".");
}

}  // namespace

Execution::Execution(int threads, ProgressCallback progress) : progress_(std::move(progress)) {
  if (threads < 0) {
    refuse("The number of threads is " + std::to_string(threads) +
           ". Give 0 for all threads of the machine, or 1 or more.");
  }
  // More threads than the machine has would not be faster.
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  arena_ = std::make_shared<Arena>(threads > 0 ? std::min(threads, machine) : machine);
}

void Execution::report(double fraction, const std::string& stage) const {
  if (!progress_) return;
  const double inside = std::clamp(fraction, 0.0, 1.0);
  double whole = progress_begin_ + inside * (progress_end_ - progress_begin_);
  {
    // The progress never goes back, except to 0 at a new beginning, because stage lengths are
    // estimates and stages may repeat. A part of zero width is not a beginning.
    const std::lock_guard<std::mutex> lock(arena_->mutex);
    const bool begins = whole == 0.0 && progress_end_ > progress_begin_;
    if (!begins) whole = std::max(whole, arena_->fraction);
    arena_->fraction = whole;
    arena_->stage = stage;
  }
  if (!progress_(whole, stage)) cancel(stage);
}

Execution Execution::part(double begin, double end) const {
  Execution result = *this;
  const double width = progress_end_ - progress_begin_;
  result.progress_begin_ = progress_begin_ + begin * width;
  result.progress_end_ = progress_begin_ + end * width;
  return result;
}

void Execution::parallel_for(std::size_t count, std::size_t block,
                             const std::function<void(std::size_t, std::size_t)>& body) const {
  const std::size_t blocks = (count + block - 1) / block;
  std::optional<CallerOfLoop> caller;
  if (progress_) caller.emplace(arena_->caller);
  const auto run = [&](std::size_t index) {
    body(index * block, std::min(count, (index + 1) * block));
    // A loop over a million elements takes seconds. Repeat the last report between its blocks, so
    // that a window stays responsive and the user can cancel.
    if (!progress_ || arena_->caller != std::this_thread::get_id()) return;
    double fraction = 0.0;
    std::string stage;
    {
      const std::lock_guard<std::mutex> lock(arena_->mutex);
      fraction = arena_->fraction;
      stage = arena_->stage;
    }
    if (!progress_(fraction, stage)) cancel(stage);
  };
  if (!arena_->workers || blocks <= 1) {
    for (std::size_t index = 0; index < blocks; ++index) run(index);
    return;
  }
  arena_->workers->for_each(blocks, run);
}

}  // namespace wscvt
