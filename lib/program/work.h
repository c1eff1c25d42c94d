// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common_arguments.h"
#include "progress_line.h"
#include "wscvt/base/execution.h"
#include "wscvt/report/report_origin.h"

namespace wscvt::program {

/// A command at work: shows on a terminal how far it is, and a signal cancels it.
class Work {
 public:
  /// From here on signals are noted. Throws wscvt::Error when the report could not be printed.
  explicit Work(const CommonArguments& arguments);

  const Execution& execution() const { return execution_; }

  /// The last chance to cancel before files are written; the line goes.
  void end();

  /// Warnings to the standard error, the lines to the standard output unless quiet.
  void print(const std::vector<std::string>& warnings, const std::vector<std::string>& lines) const;

 private:
  bool quiet_;
  ProgressLine line_;
  Execution execution_;
};

/// Prints lines to the standard output, unless quiet.
void print(const std::vector<std::string>& lines, bool quiet);

/// What a report says of where it comes from: the source, today.
ReportOrigin origin_of(const std::string& source);

}  // namespace wscvt::program
