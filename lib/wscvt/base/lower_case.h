// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace wscvt {

/// Returns the text with the letters A to Z as a to z. Other bytes stay. Does not depend on the
/// locale.
std::string lower_case(std::string_view text);

}  // namespace wscvt
