// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

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
  [[maybe_unused]] unsigned code_page_ = 0;  ///< of the console before; 0 if there is none
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

/// The numbers of the streams that the program writes.
enum class Stream { Output = 1, Error = 2 };

/// Returns the columns of the terminal that shows a stream: COLUMNS if it is set, or what the
/// terminal says, or 80. Returns 0 if the stream is a file or a pipe.
std::size_t terminal_columns(Stream stream);

/// Breaks a line between words into lines of at most `width` characters. A longer word stays whole.
/// Lines after the first begin with `indent` spaces.
std::string wrapped(std::string_view line, std::size_t width, std::size_t indent = 0);

/// Returns a text for people as the stream shows it. On a terminal, sentences are broken at its
/// width, at most 80 columns, and rows of tables stay whole. In a file or a pipe, every line stays
/// whole, because scripts read them.
std::string shown_on(Stream stream, std::string_view text);

/// Writes a sentence, in readable characters, and a line end to the standard error (see shown_on).
void print_error(std::string_view sentence);

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
