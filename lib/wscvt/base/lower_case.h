// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace wscvt {

/// Returns the text with the letters A to Z as a to z, the same in every locale; other bytes stay.
std::string lower_case(std::string_view text);

}  // namespace wscvt
