// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace wscvt::program {

/// The standard streams while the program runs. Opens /dev/null in place of closed ones, so that no
/// other file gets their numbers and their output. Writing to such a stream is still an error. On
/// Windows, also lets a console take UTF-8 and the progress line, and gives it back as it was.
class StandardStreams {
 public:
  StandardStreams();
  StandardStreams(const StandardStreams&) = delete;
  StandardStreams& operator=(const StandardStreams&) = delete;
  ~StandardStreams();  // NOLINT(performance-trivially-destructible): on Windows it does something

 private:
  unsigned code_page_ = 0;  ///< of the console before; 0 if there is none
};

/// From now on the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (closed terminal) is noted and does not
/// end the program, so that no half-written file remains. A second one ends the program. Every
/// SIGXCPU (limit of CPU time, ulimit -t) is noted. On Windows, Ctrl-C and Ctrl-Break are SIGINT,
/// and the end of the console or of the session is SIGTERM.
void note_signals();

/// From now on a file larger than the machine's limit (ulimit -f) is a write error with a message
/// and does not end the program.
void ignore_file_size_signal();

/// Returns the number of the noted signal; 0 if there was no signal.
int noted_signal();

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
