// SPDX-License-Identifier: GPL-3.0-or-later
#include "grain_run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <new>
#include <thread>

#include "progress_line.h"
#include "signals.h"
#include "wscvt/base/error.h"
#include "wscvt/base/readable_text.h"
#include "wscvt/base/text_format.h"

namespace wscvt::program {

namespace {

/// "2 h 5 min", "3 min 20 s", "7 s".
std::string duration_text(double seconds) {
  const auto all = std::llround(seconds);
  if (all >= 3600)
    return std::to_string(all / 3600) + " h " + std::to_string(all % 3600 / 60) + " min";
  if (all >= 60) return std::to_string(all / 60) + " min " + std::to_string(all % 60) + " s";
  return std::to_string(all) + " s";
}

/// Returns the text of the line on the terminal.
std::string progress_text(std::size_t done, std::size_t count, std::size_t failed, double rate) {
  std::string text = std::to_string(done) + " of " + std::to_string(count) + " grains";
  if (failed > 0) text += ", " + std::to_string(failed) + " failed";
  if (rate > 0.0) {
    text += ", " + format_number(rate, 3) + " per second, " +
            duration_text(static_cast<double>(count - done) / rate) + " left";
  }
  return text;
}

int thread_count(int asked, std::size_t grains) {
  const int all = asked > 0 ? asked : static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1,
                  static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(all), grains)));
}

/// Returns why a run was stopped, and what to do.
std::string sentence_of(const std::exception& error, const GrainRun& run) {
  if (const auto* too_large = dynamic_cast<const GrainTooLarge*>(&error)) {
    return "There is not enough memory for \"" + run.name(too_large->grain()) +
           "\", although no other grain used memory at the same time. " +
           // Threads keep memory that they have used.
           (thread_count(run.threads, run.count) > 1
                ? "Run the call again with -t 1."
                : "Use a machine with more memory, raise its limit (ulimit -v), simplify this "
                  "scan, or leave it out of the inputs.");
  }
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return "There is not enough memory. Use a machine with more memory or raise its limit (ulimit "
           "-v).";
  }
  return error.what();
}

}  // namespace

GrainRunEnd run_grains(const GrainRun& run) {
  using Clock = std::chrono::steady_clock;
  note_signals();
  ProgressLine line(!run.quiet);
  const Clock::time_point start = Clock::now();
  std::atomic<std::size_t> done{run.first};
  std::atomic<std::size_t> failed{run.failed};
  std::atomic<bool> stopped{false};
  const auto work = [&](std::size_t k) {
    return run.work(k, Execution(1, [&](double, const std::string&) {
                      return !stopped && noted_signal() == 0;
                    }));
  };
  const auto take = [&](const GrainRow& row) {
    const std::size_t grain = done;
    run.take(grain, row);
    ++done;
    if (row.error.empty()) return;
    ++failed;
    line.clear();
    std::fprintf(stderr, "Failed: %s: %s\n", readable(run.name(grain), "").c_str(),
                 readable(row.error).c_str());
  };
  GrainQueue queue(run.first, run.count, work, take);
  try {
    queue.run(thread_count(run.threads, run.count), [&] {
      const std::size_t now = done;
      const std::chrono::duration<double> seconds = Clock::now() - start;
      const double rate = static_cast<double>(now - run.first) / seconds.count();
      const double share =
          run.count == 0 ? 1.0 : static_cast<double>(now) / static_cast<double>(run.count);
      line.show(share, progress_text(now, run.count, failed, rate));
      stopped = noted_signal() != 0;
      return !stopped;
    });
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    if (known == nullptr || known->code() != ErrorCode::Cancelled) {
      throw Error(ErrorCode::InputOutput, "Stopped after " + std::to_string(done) + " of " +
                                              std::to_string(run.count) + " grains. " +
                                              sentence_of(error, run) + " " + run.when_stopped);
    }
  }
  line.clear();
  const bool was_cancelled = done < run.count;
  if (was_cancelled) {
    std::fprintf(stderr, "Cancelled after %zu of %zu grains. %s\n", done.load(), run.count,
                 run.when_stopped.c_str());
  }
  return {done, failed, was_cancelled};
}

GrainRow row_or_failure(const std::function<GrainRow()>& make,
                        const std::function<GrainRow(const std::string& sentence)>& failed) {
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

}  // namespace wscvt::program
