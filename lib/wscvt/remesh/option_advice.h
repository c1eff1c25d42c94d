// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// Explains in one or two sentences why `method` has no option with this key, and what to use
/// instead: the option belongs to the other method, or version 3 has renamed or removed it. Empty
/// if the method has the option, or no version has it.
std::string advice_for_option(std::string_view key, Method method);

/// Explains a value that version 3 has renamed or moved, or that belongs to the other method. Empty
/// for other values.
std::string advice_for_value(std::string_view key, std::string_view value, Method method);

/// Returns the keys of version 2 that version 3 does not have.
std::vector<std::string_view> replaced_options();

}  // namespace wscvt
