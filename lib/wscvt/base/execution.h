// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace wscvt {

/// Indices in a block of a loop with a short body. Large enough that the start of a block costs
/// little.
inline constexpr std::size_t usual_block = 16384;

/// Called on the thread that called the library, with the fraction of the work done, 0 to 1, and
/// the name of the stage. Returning false cancels: the library throws Error(Cancelled).
using ProgressCallback = std::function<bool(double fraction, const std::string& stage)>;

/// Settings of a run: number of threads, and progress with cancel. Cheap to copy. Any function that
/// takes an Execution may throw Error(Cancelled), even if its comment does not say so.
///
/// Results never depend on the number of threads. Work is cut into blocks whose bounds follow only
/// from the problem size, and partial sums are added in block order.
class Execution {
 public:
  /// `threads`: 0 means as many as the machine has. Throws Error(InvalidInput) below 0.
  explicit Execution(int threads = 0, ProgressCallback progress = {});

  /// Reports progress. Throws Error(Cancelled) if the callback asks to stop. `fraction` is relative
  /// to the part of the work that this Execution covers (see `part`).
  void report(double fraction, const std::string& stage) const;

  /// Returns a part. Its progress fills [begin, end] of this one's progress; 0 <= begin <= end <=
  /// 1.
  Execution part(double begin, double end) const;

  /// Calls body(begin, end) for consecutive blocks of at most `block` >= 1 indices covering [0,
  /// count), possibly at the same time. Exceptions from the body reach the caller.
  void parallel_for(std::size_t count, std::size_t block,
                    const std::function<void(std::size_t, std::size_t)>& body) const;

  /// Returns the sum of partial(begin, end) over the blocks, added in block order, so that the bits
  /// do not depend on the number of threads. `Value` needs a copy constructor, `+=` and a start
  /// value `zero`.
  template <class Value, class Partial>
  Value parallel_sum(std::size_t count, std::size_t block, Value zero,
                     const Partial& partial) const {
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<Value> partials(blocks, zero);
    parallel_for(count, block, [&](std::size_t begin, std::size_t end) {
      partials[begin / block] = partial(begin, end);
    });
    Value sum = zero;
    for (const Value& value : partials) sum += value;
    return sum;
  }

  /// Calls body(index) for every index below `count`, as parallel_for does for blocks.
  template <class Body>
  void parallel_for_each(std::size_t count, std::size_t block, const Body& body) const {
    parallel_for(count, block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t index = begin; index < end; ++index) body(index);
    });
  }

  /// As parallel_sum, where add(index, sum) adds the part of one index to the sum of its block.
  template <class Value, class Add>
  Value parallel_sum_of(std::size_t count, std::size_t block, const Value& zero,
                        const Add& add) const {
    return parallel_sum(count, block, zero, [&](std::size_t begin, std::size_t end) {
      Value sum = zero;
      for (std::size_t index = begin; index < end; ++index) add(index, sum);
      return sum;
    });
  }

 private:
  class Arena;
  std::shared_ptr<Arena> arena_;
  ProgressCallback progress_;
  double progress_begin_ = 0.0;
  double progress_end_ = 1.0;
};

}  // namespace wscvt
