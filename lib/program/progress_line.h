// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace wscvt::program {

/// A line on a terminal's standard error that shows the progress; no line if standard error is a
/// file or a pipe. Debian has no C++ library for progress lines, and this class is short.
class ProgressLine {
 public:
  /// Shows nothing if `wanted` is false.
  explicit ProgressLine(bool wanted);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { clear(); }

  /// Shows `fraction` in [0, 1] and the stage, if the text differs from the line shown.
  void show(double fraction, const std::string& stage);

  /// Clears the line, for other output.
  void clear();

 private:
  bool is_shown_;
  std::string drawn_;
};

}  // namespace wscvt::program
