// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "wscvt/remesh/remesh_options.h"

namespace wscvt {

/// Returns a sentence for an option that the method does not have but the other method has: that it
/// belongs to the other method, and what to do. Empty for any other key.
Sentence refusal_of_option(std::string_view key, Method method);

/// Returns such a sentence for a value of an option, or for a weighting that is gone.
Sentence refusal_of_value(std::string_view key, std::string_view value, Method method);

}  // namespace wscvt
