// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

}  // namespace wscvt::program
