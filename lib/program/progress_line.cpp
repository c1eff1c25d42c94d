// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_line.h"

#include <unistd.h>

#include <cstdio>

#include "wscvt/base/text.h"

namespace wscvt::program {

ProgressLine::ProgressLine(bool wanted) : is_shown_(wanted && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(double fraction, const std::string& stage) {
  if (!is_shown_) return;
  const std::string text =
      std::to_string(static_cast<int>(100.0 * fraction)) + " %  " + wscvt::readable(stage, "");
  if (text == drawn_) return;
  // Carriage return, the text, and the rest of the line cleared.
  std::fprintf(stderr, "\r%s\033[K", text.c_str());
  std::fflush(stderr);
  drawn_ = text;
}

void ProgressLine::clear() {
  if (!is_shown_ || drawn_.empty()) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_.clear();
}

}  // namespace wscvt::program
