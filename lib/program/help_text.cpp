// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_text.h"

#include <algorithm>

namespace wscvt::program {

std::string wrapped(std::string_view text) {
  constexpr std::size_t width = 100 - help_column;
  std::string result;
  std::size_t line = 0;  // characters in the last line
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (line > 0) {
      const bool fits = line + 1 + end <= width;
      result += fits ? ' ' : '\n';
      line = fits ? line + 1 : 0;
    }
    result += text.substr(0, end);
    line += end;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace wscvt::program
