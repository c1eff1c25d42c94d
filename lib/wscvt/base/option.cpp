// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/option.h"

#include "wscvt/base/text_format.h"

namespace wscvt {

std::string typed_text(double value) { return format_typed(value); }

std::string capitalised(std::string_view text) {
  std::string result(text);
  // Not std::toupper, because it depends on the locale.
  if (!result.empty() && result[0] >= 'a' && result[0] <= 'z') {
    result[0] = static_cast<char>(result[0] - 'a' + 'A');
  }
  return result;
}

}  // namespace wscvt
