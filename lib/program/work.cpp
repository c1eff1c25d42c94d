// SPDX-License-Identifier: GPL-3.0-or-later
#include "work.h"

#include <algorithm>
#include <cstdio>
#include <ctime>

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
    for (const std::string& path : written) {
      sentence += (&path == &written.front() ? " \"" : ", \"") + path + "\"";
    }
    sentence += ".";
  }
  throw Error(ErrorCode::Cancelled, sentence);
}

}  // namespace

Work::Work(const CommonArguments& arguments)
    : quiet_(arguments.quiet),
      line_(!arguments.quiet),
      execution_(arguments.threads, [this](double fraction, const std::string& stage) {
        line_.show(fraction, stage);
        if (noted_signal() != 0) cancel(stage, written_);
        return true;
      }) {
  if (!quiet_) check_writable("/dev/stdout");
  note_signals();
}

void Work::print(const std::vector<Sentence>& warnings, const std::vector<std::string>& lines) {
  line_.clear();
  print_warnings({warnings.begin(), warnings.end()});
  program::print(lines, quiet_);
}

void Work::print_log(const RemeshResult& result, bool verbose) {
  std::vector<std::string> lines = verbose ? report_lines(result) : summary_lines(result);
  // Warnings are printed once, before.
  lines.erase(
      std::remove_if(lines.begin(), lines.end(),
                     [](const std::string& line) { return line.rfind("Warning ", 0) == 0; }),
      lines.end());
  for (const std::string& path : written_) {
    lines.push_back((&path == &written_.front() ? "Files       \"" : "            \"") + path +
                    "\"");
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin_;
  lines.push_back("Time        " + format_number(seconds.count(), 2) + " s");
  lines.push_back(verdict_line(result));
  print(result.warnings, lines);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::fprintf(stderr, "Warning: %s\n", readable(warning).c_str());
  }
}

void print(const std::vector<std::string>& lines, bool quiet) {
  if (quiet) return;
  std::string text;
  for (const std::string& line : lines) text += readable(line) + "\n";
  write_file("/dev/stdout", text);
}

ReportOrigin origin_of(const std::string& source) { return {source, today()}; }

}  // namespace wscvt::program
