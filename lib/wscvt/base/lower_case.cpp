// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/lower_case.h"

namespace wscvt {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  // Not std::tolower, because it depends on the locale.
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return lower;
}

}  // namespace wscvt
