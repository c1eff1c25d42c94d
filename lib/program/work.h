// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common_arguments.h"
#include "progress_line.h"
#include "wscvt/base/execution.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

/// The share of the progress that reading takes: of the files' megabytes, next to what follows.
inline constexpr double reading_share = 0.05;

/// A command at work: shows on a terminal how far it is, and a signal cancels it, with a sentence
/// that says which of its files are there.
class Work {
 public:
  /// From here on signals are noted. Throws wscvt::Error when the report could not be printed.
  explicit Work(const CommonArguments& arguments);

  /// Of what comes before the first file is written.
  const Execution& execution() const { return execution_; }

  /// Calls write_it(path, execution), which makes and writes one of the files. Throws what that
  /// throws, and wscvt::Error(Cancelled).
  template <class Write>
  void write(const std::string& path, const Write& write_it) {
    const Execution writing = execution_.part(1.0, 1.0);
    writing.report(1.0, "Writing \"" + path + "\"");
    write_it(path, writing);
    written_.push_back(path);
  }

  /// Warnings to the standard error, the lines to the standard output unless quiet. The line goes.
  void print(const std::vector<std::string>& warnings, const std::vector<std::string>& lines);

 private:
  bool quiet_;
  ProgressLine line_;
  std::vector<std::string> written_;
  Execution execution_;
};

/// Prints lines to the standard output, unless quiet.
void print(const std::vector<std::string>& lines, bool quiet);

/// What a report says of where it comes from: the source, today.
ReportOrigin origin_of(const std::string& source);

}  // namespace wscvt::program
