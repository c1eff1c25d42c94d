// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace wscvt {

/// Returns the sentence with each program option in it ("--max-overhang") replaced by the result of
/// `name_of` for its key ("max-overhang"). The library's sentences name options as the program
/// does. Each host shows the name that its user sees on the screen or in the script.
std::string with_option_names(std::string_view sentence,
                              const std::function<std::string(std::string_view key)>& name_of);

}  // namespace wscvt
