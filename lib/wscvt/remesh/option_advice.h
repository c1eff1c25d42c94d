// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// Returns why a remesh by `method` has no option with this key, in one or two sentences that say
/// what to use instead: it belongs to the other method, or version 3 has renamed or removed it.
/// Empty for a key that no version has, and for an option of the method.
std::string advice_for_option(std::string_view key, Method method);

/// Returns such sentences for a value of version 2 that version 3 has renamed or moved, and for a
/// value of the other method; empty for others.
std::string advice_for_value(std::string_view key, std::string_view value, Method method);

/// Returns the keys of version 2 that version 3 does not have.
std::vector<std::string_view> replaced_options();

}  // namespace wscvt
