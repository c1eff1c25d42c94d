// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace wscvt {

/// Returns the sentence with every option name of the program ("--max-overhang") replaced by the
/// result of `name_of` for its key ("max-overhang"). The library's messages contain the program's
/// names. Each host replaces them by the names that its user sees on the screen or in the script.
std::string with_option_names(std::string_view sentence,
                              const std::function<std::string(std::string_view key)>& name_of);

}  // namespace wscvt
