// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/terminal/work.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include "program/call/exit_code.h"
#include "program/terminal/terminal.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"

namespace wscvt::program {

namespace {

/// Returns the local date, "2026-11-21"; empty if the clock fails.
std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  char text[sizeof "2026-11-21"];
  if (::localtime_r(&now, &local) == nullptr) return "";
  return std::strftime(text, sizeof text, "%Y-%m-%d", &local) == 0 ? "" : text;
}

/// Throws Cancelled with the files written, which the library's message does not contain.
[[noreturn]] void cancel(const std::string& stage, const std::vector<std::string>& written) {
  std::string sentence = (stage.empty() ? "Cancelled" : "Cancelled during: " + stage) + ". ";
  if (written.empty()) {
    sentence += "Nothing was written.";
  } else {
    sentence += "Written before that:";
    constexpr std::size_t most = 5;  // a packing has a thousand grains
    const std::size_t named = std::min(most, written.size());
    for (std::size_t k = 0; k < named; ++k) {
      sentence += (k == 0 ? " \"" : ", \"") + written[k] + "\"";
    }
    const std::size_t others = written.size() - named;
    sentence += others == 0 ? "." : ", and " + format_count(others, "other file") + ".";
  }
  throw Error(ErrorCode::Cancelled, sentence);
}

}  // namespace

Work::Work(int threads, bool quiet)
    : quiet_(quiet),
      line_(!quiet),
      execution_(threads, [this](double fraction, const std::string& stage) {
        line_.show(fraction, stage);
        if (noted_signal() != 0) cancel(stage, written_);
        return true;
      }) {
  if (!quiet_) check_writable("/dev/stdout");
  note_signals();
}

void Work::print(const std::vector<Sentence>& warnings, std::vector<std::string> lines,
                 const std::string& folder, const std::string& last_line) {
  line_.clear();
  print_warnings({warnings.begin(), warnings.end()});
  for (std::string& line :
       end_of_log(folder.empty() ? written_ : std::vector<std::string>{folder}, begin_)) {
    lines.push_back(std::move(line));
  }
  if (!last_line.empty()) lines.push_back(last_line);
  program::print(lines, quiet_);
}

void Work::print_log(const RemeshResult& result, bool verbose, std::vector<std::string> lines) {
  for (std::string& line : verbose ? report_lines(result) : summary_lines(result)) {
    // Warnings are printed once, before.
    if (line.rfind("Warning ", 0) != 0) lines.push_back(std::move(line));
  }
  print(verbose ? report_warnings(result) : result.warnings, std::move(lines), "",
        verdict_line(result));
}

std::vector<std::string> end_of_log(const std::vector<std::string>& written,
                                    std::chrono::steady_clock::time_point begin) {
  std::string files;
  for (const std::string& path : written) files += (files.empty() ? "\"" : ", \"") + path + "\"";
  std::vector<std::string> lines;
  if (!files.empty()) lines.push_back("Files       " + files);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  lines.push_back("Time        " + format_number(seconds.count(), 2) + " s");
  return lines;
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    print_error("Warning: " + warning);
  }
}

void print(const std::vector<std::string>& lines, bool quiet) {
  if (quiet) return;
  std::string text;
  for (const std::string& line : lines) text += readable(line) + "\n";
  write_file("/dev/stdout", shown_on(Stream::Output, text));
}

void print_made(std::vector<std::string> lines, const std::string& folder,
                std::chrono::steady_clock::time_point begin, bool quiet) {
  for (std::string& line : end_of_log({folder}, begin)) lines.push_back(std::move(line));
  print(lines, quiet);
}

ReportOrigin origin_of(const std::string& source) { return {source, today()}; }

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

}  // namespace

JobEnd on_terminal(int threads, bool quiet, const std::function<JobEnd(const JobHost&)>& run) {
  using Clock = std::chrono::steady_clock;
  note_signals();
  ProgressLine line(!quiet);
  const Clock::time_point start = Clock::now();
  JobHost host;
  host.threads = threads;
  host.progress = [&](const JobProgress& now) {
    const std::chrono::duration<double> seconds = Clock::now() - start;
    const double rate = static_cast<double>(now.done - now.first) / seconds.count();
    const double share =
        now.count == 0 ? 1.0 : static_cast<double>(now.done) / static_cast<double>(now.count);
    line.show(share, progress_text(now.done, now.count, now.failed, rate));
    return true;
  };
  host.is_cancelled = [] { return noted_signal() != 0; };
  host.failed = [&](const std::string& grain, const std::string& error) {
    line.clear();
    print_error("Failed: " + readable(grain, "") + ": " + error);
  };
  JobEnd end = run(host);
  line.clear();
  if (end.was_cancelled()) {
    print_error("Cancelled after " + std::to_string(end.done) + " of " + std::to_string(end.count) +
                " grains. " + end.when_stopped);
  }
  return end;
}

JobEnd run_grains(const GrainRun& run, int threads, bool quiet) {
  return on_terminal(threads, quiet,
                     [&](const JobHost& host) { return wscvt::run_grains(run, host); });
}

JobEnd run_job(const GrainJob& job, GrainSource& grains, int threads, bool quiet) {
  return on_terminal(threads, quiet, [&](const JobHost& host) {
    return checked([&] { return wscvt::run_job(job, grains, host); });
  });
}

std::string end_line(const GrainJob& job, const JobEnd& end) {
  const JobFolder folder = folders_of(job).front();
  const std::size_t warned = grains_with_warnings(job);
  return format_count(end.done, "grain") + ", " +
         (warned == 0 ? "" : std::to_string(warned) + " of them with warnings, ") +
         std::to_string(end.failed) + " failed: " + folder.file(job.tables.front().name, ".csv");
}

}  // namespace wscvt::program
