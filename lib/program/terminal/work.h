// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "program/terminal/terminal.h"
#include "toolbox/job/grain_job.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/output_file.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

/// Fraction of the progress that is given to reading.
inline constexpr double reading_share = 0.05;

/// The work of a command: shows its progress on a terminal. A signal cancels it, with a message
/// that lists the files written.
class Work {
 public:
  /// Starts to note signals. Throws wscvt::Error if the report cannot be printed.
  Work(int threads, bool quiet);

  /// Returns the Execution of the work before the first file is written.
  const Execution& execution() const { return execution_; }

  /// Returns the Execution of what makes the content of files.
  Execution writing() const { return execution_.part(1.0, 1.0); }

  /// Calls write_it(), which makes and writes the file of this path. Throws its exceptions, and
  /// wscvt::Error(Cancelled).
  template <class Write>
  void write(const std::string& path, const Write& write_it) {
    writing().report(1.0, "Writing \"" + path + "\"");
    write_it();
    written_.push_back(path);
  }

  /// Writes the text that content() returns.
  template <class Content>
  void write_text(const std::string& path, const Content& content) {
    write(path, [&] { write_file(path, content()); });
  }

  /// Writes the reports of a result, each in the format of its file's name. `more`: what its
  /// write_report takes besides.
  template <class Result, class... More>
  void write_reports(const std::vector<std::string>& reports, const Result& result,
                     const ReportOrigin& origin, const More&... more) {
    for (const std::string& report : reports) {
      write(report, [&] { write_report(report, result, origin, more..., writing()); });
    }
  }

  /// Clears the progress line. Prints warnings to the standard error. Unless quiet, prints to the
  /// standard output the lines, the files written, or only their folder if it is given, the seconds
  /// since the work began, and the last line if it is given.
  void print(const std::vector<Sentence>& warnings, std::vector<std::string> lines,
             const std::string& folder = "", const std::string& last_line = "");

  /// Prints the log of a remesh: the warnings, other lines, a summary or the whole report, and the
  /// verdict as the last line.
  void print_log(const RemeshResult& result, bool verbose, std::vector<std::string> lines = {});

 private:
  bool quiet_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  ProgressLine line_;
  std::vector<std::string> written_;
  Execution execution_;
};

/// Returns the lines of a log that tell the files or the folder written, and the seconds since
/// `begin`.
std::vector<std::string> end_of_log(const std::vector<std::string>& written,
                                    std::chrono::steady_clock::time_point begin);

/// Returns the result of `work`, with a progress line on a terminal unless quiet. A signal cancels.
template <class DoWork>
auto with_progress(bool quiet, const DoWork& work) {
  note_signals();
  ProgressLine line(!quiet);
  return work(Execution(1, [&](double fraction, const std::string& stage) {
    line.show(fraction, stage);
    return noted_signal() == 0;
  }));
}

/// Prints warnings to the standard error.
void print_warnings(const std::vector<std::string>& warnings);

/// Prints lines to the standard output, unless quiet.
void print(const std::vector<std::string>& lines, bool quiet);

/// Prints lines, and those of end_of_log.
void print_made(std::vector<std::string> lines, const std::string& folder,
                std::chrono::steady_clock::time_point begin, bool quiet);

/// Returns the origin for a report: the source and today's date.
ReportOrigin origin_of(const std::string& source);

// Work on many grains, with a progress line on a terminal unless quiet. Failures are printed to the
// standard error, and so is a run that a signal cancelled. `threads`: 0 uses all.

JobEnd on_terminal(int threads, bool quiet, const std::function<JobEnd(const JobHost&)>& run);

JobEnd run_grains(const GrainRun& run, int threads, bool quiet);

/// Throws WrongCall if files would replace each other, or the folder is of another call.
JobEnd run_job(const GrainJob& job, GrainSource& grains, int threads, bool quiet);

/// "40 grains, 3 of them with warnings, 1 failed: out/grains.csv".
std::string end_line(const GrainJob& job, const JobEnd& end);

}  // namespace wscvt::program
