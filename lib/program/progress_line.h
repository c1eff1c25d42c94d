// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace wscvt::program {

/// One line on a terminal's standard error that says how far the work is; nothing where standard
/// error is a file or a pipe. Debian carries no C++ library that draws one, and this is short.
class ProgressLine {
 public:
  /// Shows nothing when not `wanted`.
  explicit ProgressLine(bool wanted);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { clear(); }

  /// `fraction` in [0, 1] and the stage; drawn when it differs from what stands there.
  void show(double fraction, const std::string& stage);

  /// Empties the line, for other output.
  void clear();

 private:
  bool is_shown_;
  std::string drawn_;
};

}  // namespace wscvt::program
