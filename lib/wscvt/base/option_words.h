// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace wscvt {

/// The sentence with each option that it names as the program takes it ("--max-overhang") replaced
/// by what `name_of` returns for its key ("max-overhang"). The library's sentences name options so;
/// each host shows its user the name that stands on the screen or in the script.
std::string with_option_names(std::string_view sentence,
                              const std::function<std::string(std::string_view key)>& name_of);

}  // namespace wscvt
