// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/execution.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

class Execution::Arena {
 public:
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

Execution::Execution(int threads, ProgressCallback progress) : progress_(std::move(progress)) {
  if (threads < 0) {
    throw Error(ErrorCode::InvalidInput, "The number of threads is " + std::to_string(threads) +
                                             "; give 0 for all of the machine's, or 1 and more.");
  }
  const int machine = tbb::info::default_concurrency();
  // More than the machine has would gain nothing, and TBB writes a warning to stderr.
  const int workers = threads > 0 ? std::min(threads, machine) : machine;
  if (workers > 1) arena_ = std::make_shared<Arena>(workers);
}

void Execution::report(double fraction, const std::string& stage) const {
  if (!progress_) return;
  const double inside = std::clamp(fraction, 0.0, 1.0);
  if (!progress_(progress_begin_ + inside * (progress_end_ - progress_begin_), stage)) {
    throw Error(ErrorCode::Cancelled, "Cancelled during: " + stage + ". Nothing was changed.");
  }
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
  const auto run = [&](std::size_t index) {
    body(index * block, std::min(count, (index + 1) * block));
  };
  if (!arena_ || blocks <= 1) {
    for (std::size_t index = 0; index < blocks; ++index) run(index);
    return;
  }
  arena_->arena.execute([&] { tbb::parallel_for(std::size_t{0}, blocks, run); });
}

}  // namespace wscvt
